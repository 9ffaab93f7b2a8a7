// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace episcope::cli {

/// A table of texts in UTF-8; every row has as many cells as the header.
struct Table {
  std::vector<std::string> header;
  std::vector<std::vector<std::string>> rows;
};

/// Columns aligned for people: the first to the left, the others to the right.
[[nodiscard]] std::string table_to_text(const Table& table);
/// RFC 4180, "." as the decimal point.
[[nodiscard]] std::string table_to_csv(const Table& table);
/// A `tabular` with rules of booktabs.
[[nodiscard]] std::string table_to_latex(const Table& table);

/// Letters of a UTF-8 text.
[[nodiscard]] std::size_t letters_in(const std::string& text);

}  // namespace episcope::cli
