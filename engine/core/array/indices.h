// SPDX-License-Identifier: BSD-3-Clause
#pragma once

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

}  // namespace episcope
