// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

namespace episcope::cli {

/// Columns that help has: those of the terminal that standard output is, else of the environment
/// (COLUMNS), else 80; between 40 and 100.
[[nodiscard]] int help_columns();

/// Text in lines of at most `columns` letters, broken at spaces where that is possible. A line that
/// begins with spaces stays one of its own, and is continued two further in; others are joined to
/// paragraphs. Letters of several bytes count once.
[[nodiscard]] std::string wrapped(std::string_view text, int columns);

/// An entry of a list: `name` two in, and `text` from column `indent` on, on the next line if the
/// name is too long.
[[nodiscard]] std::string help_entry(const std::string& name, const std::string& text, int indent,
                                     int columns);

}  // namespace episcope::cli
