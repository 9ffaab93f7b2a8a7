// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <string>

namespace episcope {

/// A view of the camera grid. `u` is the camera column, growing to the camera's right; `v` is the
/// camera row, growing downwards.
struct ViewIndex {
  int v = 0;
  int u = 0;
  friend bool operator==(const ViewIndex&, const ViewIndex&) = default;
};

/// "4,4".
[[nodiscard]] inline std::string view_text(ViewIndex view) {
  return std::to_string(view.v) + "," + std::to_string(view.u);
}

/// A pixel of one view: `x` to the right, `y` downwards, both from 0.
struct PixelIndex {
  int y = 0;
  int x = 0;
  friend bool operator==(const PixelIndex&, const PixelIndex&) = default;
};

/// Number of views: `v` rows by `u` columns.
struct GridShape {
  int v = 0;
  int u = 0;
  [[nodiscard]] int count() const { return v * u; }
  /// View number `index`, counted row by row, of a grid that begins at `first`.
  [[nodiscard]] ViewIndex view_at(int index, ViewIndex first = {}) const {
    return {first.v + index / u, first.u + index % u};
  }
  /// The middle view; of an even count the one right of or below the middle.
  [[nodiscard]] ViewIndex center() const { return {v / 2, u / 2}; }
  [[nodiscard]] bool contains(ViewIndex view) const {
    return view.v >= 0 && view.v < v && view.u >= 0 && view.u < u;
  }
  friend bool operator==(const GridShape&, const GridShape&) = default;
};

/// A closed interval, for disparities in px per view step and for display ranges.
struct Interval {
  double min = 0;
  double max = 0;
  [[nodiscard]] double length() const { return max - min; }
  friend bool operator==(const Interval&, const Interval&) = default;
};

/// A rectangle of views of the camera grid.
struct ViewRectangle {
  ViewIndex first;
  GridShape grid{1, 1};
};

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

/// Most views of a grid whose reports use all pixels. Reports on larger grids use a part of the
/// pixels of each view, since reading all takes seconds (1.3 GB in 27×27 views).
inline constexpr int kLookedAtClosely = 81;

/// Whether reports on views of this grid come from a part of the pixels. Measurements that change
/// samples or mark pixels as invalid always use all of them.
[[nodiscard]] inline bool has_many_views(GridShape grid) {
  return grid.count() > kLookedAtClosely;
}

}  // namespace episcope
