// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/io/order/motion_pictures.h"

#include <array>
#include <vector>

namespace episcope::io {

/// A list of views understood as rows of `period` views, every second one turned round if `snake`.
/// Which image axis the rows run along is left open; a period of the whole list is a line.
struct Arrangement {
  int period = 1;
  bool snake = false;

  struct Place {
    int row = 0;
    int column = 0;
  };
  [[nodiscard]] Place place(int index) const;
  friend bool operator==(const Arrangement&, const Arrangement&) = default;
};

/// Every way to cut a list of `count` views into rows of equal length, the line last.
[[nodiscard]] std::vector<Arrangement> arrangements(int count);

/// How unlike pairs of views are, as a number that grows with the distance of the cameras.
struct Unlikeness {
  std::vector<std::array<int, 2>> pairs;  ///< Of places in the list.
  std::vector<double> values;

  /// The share of the variance of the unlikeness that is left when it may only grow with the
  /// distance of the views in this arrangement, with the best of several ratios of the two steps:
  /// 0 = fits perfectly, about 1 = not at all.
  [[nodiscard]] double unexplained(const Arrangement& arrangement) const;
};

}  // namespace episcope::io
