// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/io/models/names/name_parts.h"

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace episcope::io {

/// What the numbers in the names of a group are.
struct IndexFields {
  enum class Form {
    Grid,     ///< Row and column of every place of a full grid,
    Gaps,     ///< of a grid with places that are missing,
    List,     ///< or one index.
    Unclear,  ///< Several numbers vary, and none or several pairs of them form a grid.
    None      ///< No number varies, or there are less than two names.
  };
  Form form = Form::None;
  std::optional<std::size_t> row{};
  std::optional<std::size_t> column{};
  std::optional<std::size_t> index{};
  std::optional<std::size_t> y{};  ///< Positions of cameras.
  std::optional<std::size_t> x{};
  bool is_told_by_words = false;  ///< Which number is the row and which the column.
  bool are_signed = false;        ///< Rows and columns are numbered from a negative number on.
};

/// Finds row and column of a grid among the numbers of names. Negative numbers and those with a
/// fraction anywhere are positions, not indices, unless no other number varies and two of them, in
/// equal steps from below 0 to above it, form a full grid: −2 … 2 by −2 … 2. An index runs in equal
/// steps; of several pairs of numbers that form a full grid those beside words such as row and col
/// come first, then those that begin at 0 or 1 without gaps, then neighbours; numbers that only
/// repeat a pair in another form are passed over. One number that varies beside one that is
/// constantly 0 or 1 and written alike is a single row or column. The first two positions behind
/// row and column are y and x, unless words tell otherwise. Linear in the number of names.
[[nodiscard]] IndexFields find_index_fields(const NameGroup& group);

/// The pattern of the names with these fields: "out_{row}_{col}_{y}_{x}.png"; numbers that vary
/// otherwise are "*".
[[nodiscard]] std::string pattern_text(const NameGroup& group, const IndexFields& fields);

/// Separates row and column in names where their digits run together, as in view11.png …
/// view99.png: the only number that varies has an even count of digits everywhere, its halves run
/// over a full grid from 0 or 1 on, and as one number it would have gaps. Other groups stay as they
/// are.
void separate_joined_digits(NameGroup& group);

/// Joins groups whose names differ in one letter that stands alone and runs from a on, as in A1,
/// A2 … C9: the letter then is a number, from 1 on. Three letters at least, with as many images
/// each, that form a grid together; other groups stay as they are.
void join_lettered_rows(std::vector<NameGroup>& groups);

/// The folders in the order of their letters, if these are their names and run from a on; at least
/// three.
[[nodiscard]] std::optional<std::vector<std::filesystem::path>> by_letter(
    std::vector<std::filesystem::path> folders);

}  // namespace episcope::io
