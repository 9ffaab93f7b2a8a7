// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace episcope::io {

/// The different values of an index, ascending, as a run in equal steps with or without gaps.
struct NumberRun {
  std::vector<long long> values;
  long long step = 1;  ///< The greatest one on which all values lie.

  /// Sorts and thins out `all`, which must not be empty.
  explicit NumberRun(std::vector<long long> all);

  /// Number of steps from the first value to the last, gaps included.
  [[nodiscard]] long long length() const { return (values.back() - values.front()) / step + 1; }
  [[nodiscard]] bool has_gaps() const { return length() != static_cast<long long>(values.size()); }
  /// Whether more is missing than there is: then it is no index.
  [[nodiscard]] bool is_scattered() const {
    return length() > 2 * static_cast<long long>(values.size());
  }
  /// The values with those that are missing between them, if it is an index.
  [[nodiscard]] std::vector<long long> filled() const;
  /// 0 … n−1 or 1 … n.
  [[nodiscard]] bool is_plain() const {
    return !has_gaps() && step == 1 && (values.front() == 0 || values.front() == 1);
  }
  /// The place of a value, from 0; nothing if it is none of them.
  [[nodiscard]] std::optional<std::size_t> place_of(long long value) const;
  /// "0 … 8", "0, 2 … 16", "2, 5, 6".
  [[nodiscard]] std::string text() const;
};

}  // namespace episcope::io
