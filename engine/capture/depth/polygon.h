// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <vector>

namespace episcope::capture {

/// A point of the image plane, in px.
struct Corner {
  double x;
  double y;
};

/// The half-plane a·x + b·y + c ≥ 0.
struct HalfPlane {
  double a = 0;
  double b = 0;
  double c = 0;
  [[nodiscard]] double at(const Corner& p) const { return a * p.x + b * p.y + c; }
};

/// A convex polygon, of either orientation, without memory of its own.
struct Polygon {
  static constexpr int kMost = 24;    ///< Corners: a triangle cut by a square has at most 7.
  std::array<Corner, kMost> corners;  ///< The first `count`; others are not initialised.
  int count = 0;

  void add(const Corner& corner) {
    if (count < kMost) corners[count++] = corner;
  }
};

/// Twice the signed area, from the first corner.
[[nodiscard]] double twice_area(const Polygon& polygon);
/// The centroid; of a polygon without area its first corner. Precondition: not empty.
[[nodiscard]] Corner centroid(const Polygon& polygon);
/// The part in the half-plane (Sutherland and Hodgman); empty if there is none.
[[nodiscard]] Polygon clipped(const Polygon& polygon, const HalfPlane& half);
/// The part in the square of a pixel around (0, 0).
[[nodiscard]] Polygon clipped_to_pixel(const Polygon& polygon);

/// Whether an edge of `a` keeps `b` outside, up to rounding; then they do not overlap.
/// Precondition: the area of `a` is not negative.
[[nodiscard]] bool edge_parts(const Polygon& a, const Polygon& b);

/// Appends to `pieces` the convex parts of `polygon` outside of the convex `hole`.
void subtract(const Polygon& polygon, const Polygon& hole, std::vector<Polygon>& pieces);

}  // namespace episcope::capture
