// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace episcope {

/// A table of texts in UTF-8; every row has as many cells as the header.
struct TextTable {
  std::vector<std::string> header;
  std::vector<std::vector<std::string>> rows;
  std::vector<std::vector<bool>> stressed{};  ///< Cells of rows in bold, in LaTeX; empty = none.
};

/// Aligned columns: the first to the left, the others to the right.
[[nodiscard]] std::string table_to_text(const TextTable& table);
/// Aligned columns, transposed if that makes shorter lines (few rows of many columns).
[[nodiscard]] std::string table_to_narrow_text(const TextTable& table);
/// RFC 4180, "." as the decimal point.
[[nodiscard]] std::string table_to_csv(const TextTable& table);
/// A `tabular` with rules of booktabs, stressed cells in bold.
[[nodiscard]] std::string table_to_latex(const TextTable& table);

/// Rows and columns swapped: the first column becomes the header.
[[nodiscard]] TextTable transposed(const TextTable& table);

/// A number with a fixed number of digits after the point: 0.25 with 3 is "0.250".
[[nodiscard]] std::string fixed_text(double value, int digits);

/// Number of characters (code points) of a UTF-8 text.
[[nodiscard]] std::size_t character_count(const std::string& text);

}  // namespace episcope
