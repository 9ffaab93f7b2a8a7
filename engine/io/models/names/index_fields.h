// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/io/models/names/name_parts.h"

#include <cstddef>
#include <optional>
#include <string>

namespace episcope::io {

/// Meaning of the numbers in the names of a group.
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

/// Finds row and column among the numbers of names. Numbers with a fraction or a minus are
/// positions, not indices. An exception: two numbers in equal steps from below 0 to above it that
/// form a full grid, −2 … 2 by −2 … 2, if no other number varies. An index runs in equal steps. Of
/// several pairs that form a full grid, pairs beside words such as row and col come first, then
/// pairs that begin at 0 or 1 without gaps, then neighbors. Numbers that repeat a pair in another
/// form are skipped. One varying number beside a constant 0 or 1 in its form is a single row or
/// column. The first two positions behind row and column are y and x, unless words tell otherwise.
/// Linear in the number of names.
[[nodiscard]] IndexFields find_index_fields(const NameGroup& group);

/// Pattern of the names with these fields: "out_{row}_{col}_{y}_{x}.png". Other varying numbers
/// become "*".
[[nodiscard]] std::string pattern_text(const NameGroup& group, const IndexFields& fields);

/// Separates row and column in names where their digits run together, as in view11.png …
/// view99.png. The only varying number must have an even count of digits everywhere, its halves
/// must run over a full grid from 0 or 1 on, and as one number it must have gaps. Other groups stay
/// as they are.
void separate_joined_digits(NameGroup& group);

}  // namespace episcope::io
