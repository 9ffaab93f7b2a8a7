// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/capture/depth/polygon.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace episcope::capture {

/// A vertex as a view sees it: place in px, and 1/Z, which is affine in the place on every plane.
struct ScreenVertex {
  float x = 0;
  float y = 0;
  float w = 0;  ///< 1/Z, > 0; 0 = not in front of the camera.
};

/// A plane in space as a view sees it: 1/Z at (x, y).
struct InversePlane {
  double by_x = 0;
  double by_y = 0;
  double at_zero = 0;
  [[nodiscard]] double at(const Corner& p) const { return by_x * p.x + by_y * p.y + at_zero; }
};

/// A triangle around a pixel: places relative to the centre of the pixel.
struct ScreenTriangle {
  Polygon polygon;
  InversePlane plane;
  bool is_front = false;  ///< Seen from outside.
};

/// Twice the signed area; below 0 = seen from outside, since y grows downwards.
[[nodiscard]] inline double turn_of(const std::array<ScreenVertex, 3>& v) {
  return (static_cast<double>(v[1].x) - v[0].x) * (static_cast<double>(v[2].y) - v[0].y) -
         (static_cast<double>(v[2].x) - v[0].x) * (static_cast<double>(v[1].y) - v[0].y);
}

/// The triangle around pixel (x, y). Precondition: `turn_of(v)` is not 0.
[[nodiscard]] inline ScreenTriangle around_pixel(const std::array<ScreenVertex, 3>& v, int x,
                                                 int y) {
  ScreenTriangle triangle;
  for (const ScreenVertex& vertex : v) {
    triangle.polygon.add({static_cast<double>(vertex.x) - x, static_cast<double>(vertex.y) - y});
  }
  const auto& c = triangle.polygon.corners;
  const double turn = turn_of(v);
  const double w1 = static_cast<double>(v[1].w) - v[0].w;
  const double w2 = static_cast<double>(v[2].w) - v[0].w;
  InversePlane& plane = triangle.plane;
  plane.by_x = (w1 * (c[2].y - c[0].y) - w2 * (c[1].y - c[0].y)) / turn;
  plane.by_y = (w2 * (c[1].x - c[0].x) - w1 * (c[2].x - c[0].x)) / turn;
  plane.at_zero = v[0].w - plane.by_x * c[0].x - plane.by_y * c[0].y;
  triangle.is_front = turn < 0;
  return triangle;
}

}  // namespace episcope::capture
