// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/io/grid/name_parts.h"

#include <cstddef>
#include <string>
#include <vector>

namespace episcope::io {

/// What the words beside two numbers of a name say of them.
enum class WordOrder { Unknown, RowFirst, ColumnFirst };

/// Words of a group's names, in lower case.
class NameWords {
 public:
  explicit NameWords(const std::string& skeleton);

  /// By the words before both numbers, or those that follow both: row and col(umn), r and c, y
  /// and x, v and u, t and s, in either order; row or col(umn) alone tells too. The letter alone
  /// does not, because it may stand for anything.
  [[nodiscard]] WordOrder order_of(std::size_t first, std::size_t second) const;

  /// Whether a word says that a number counts something else: frames, times, exposures.
  [[nodiscard]] bool is_other_count(std::size_t number) const;

  /// Whether nothing but a separator stands before a number.
  [[nodiscard]] bool is_free(std::size_t number) const { return free_[number]; }

 private:
  std::vector<std::string> before_;  ///< The word before each number; may be empty.
  std::vector<std::string> after_;   ///< The word that follows it at once.
  std::vector<bool> free_;
};

/// Whether names hold a word for what belongs to views and is none itself: label, mask, depth,
/// disparity, normal, thumbnail, …
[[nodiscard]] bool names_companions(const std::string& skeleton);

/// Whether names hold a word for one image that is a light field of its own: eslf, macpi.
[[nodiscard]] bool names_mosaics(const std::string& skeleton);

}  // namespace episcope::io
