// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "annotation/paint/pixel_region.h"

namespace episcope {

/// A position on a view in px: the pixel (y, x) covers [x, x + 1) × [y, y + 1), its centre lies at
/// (x + 0.5, y + 0.5).
struct StrokePoint {
  double y = 0;
  double x = 0;
};

/// The path of a round brush between two points of a stroke.
struct BrushPath {
  StrokePoint from;
  StrokePoint to;
  double diameter_px = 1;
};

constexpr double kMinBrush_px = 1;
constexpr double kMaxBrush_px = 100;

/// Pixels of a `height` × `width` view that the brush covers: those whose centre lies within half
/// the diameter of the segment from → to, and the two that contain its ends, so that even the
/// thinnest brush leaves a mark wherever it is set down. At most one span per row, from top to
/// bottom. Complexity O(rows). Throws InvalidInput for a diameter outside [1, 100] or a point that
/// is not finite.
[[nodiscard]] PixelRegion covered_pixels(const BrushPath& path, int height, int width);

}  // namespace episcope
