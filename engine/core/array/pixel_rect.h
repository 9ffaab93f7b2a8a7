// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>

namespace episcope {

/// The pixels of rows [y0, y1) and columns [x0, x1) of an image.
struct PixelRect {
  int y0 = 0;
  int x0 = 0;
  int y1 = 0;
  int x1 = 0;
  [[nodiscard]] bool empty() const { return y0 >= y1 || x0 >= x1; }
  /// Becomes the smallest rectangle that holds both; an empty `other` changes nothing.
  void include(const PixelRect& other) {
    if (other.empty()) return;
    *this = empty() ? other
                    : PixelRect{std::min(y0, other.y0), std::min(x0, other.x0),
                                std::max(y1, other.y1), std::max(x1, other.x1)};
  }
  friend bool operator==(const PixelRect&, const PixelRect&) = default;
};

}  // namespace episcope
