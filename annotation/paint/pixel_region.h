// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <vector>

namespace episcope {

/// Pixels [x0, x1) of row y.
struct PixelSpan {
  int y = 0;
  int x0 = 0;
  int x1 = 0;
  friend bool operator==(const PixelSpan&, const PixelSpan&) = default;
};

/// A set of pixels of one view.
using PixelRegion = std::vector<PixelSpan>;

/// Pixels [x0, x1) of rows [y0, y1).
struct PixelRect {
  int y0 = 0;
  int x0 = 0;
  int y1 = 0;
  int x1 = 0;
  [[nodiscard]] bool empty() const { return y0 >= y1 || x0 >= x1; }
  /// Grows to hold `span` too.
  void include(PixelSpan span) { include(PixelRect{span.y, span.x0, span.y + 1, span.x1}); }
  void include(const PixelRect& other) {
    if (other.empty()) return;
    *this = empty() ? other
                    : PixelRect{std::min(y0, other.y0), std::min(x0, other.x0),
                                std::max(y1, other.y1), std::max(x1, other.x1)};
  }
  friend bool operator==(const PixelRect&, const PixelRect&) = default;
};

}  // namespace episcope
