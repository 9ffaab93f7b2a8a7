// SPDX-License-Identifier: BSD-3-Clause
#include "annotation/paint/warp_disparity.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace episcope {
namespace {

constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();

/// How far pixels move.
int largest_motion(const DisparityView& source, ViewIndex step) {
  float largest = 0;
  for (int y = 0; y < source.disparity.height; ++y) {
    for (int x = 0; x < source.disparity.width; ++x) {
      if (source.is_valid(y, x)) largest = std::max(largest, std::abs(source.disparity.at(y, x)));
    }
  }
  const int steps = std::max(std::abs(step.v), std::abs(step.u));
  const int extent = std::max(source.disparity.height, source.disparity.width);
  return static_cast<int>(
      std::ceil(std::min(largest * static_cast<float>(steps), static_cast<float>(extent))));
}

/// The nearest surface at each pixel. Surfaces at the border are taken to go on outside the
/// picture, so that they hide what they would there.
Image<float> splat(const DisparityView& source, ViewIndex step) {
  const ImageView<const float>& disparity = source.disparity;
  Image<float> nearest(disparity.height, disparity.width, 1, kUnknown);
  const int margin = largest_motion(source, step);
  for (int y = -margin; y < disparity.height + margin; ++y) {
    for (int x = -margin; x < disparity.width + margin; ++x) {
      const PixelIndex from{std::clamp(y, 0, disparity.height - 1),
                            std::clamp(x, 0, disparity.width - 1)};
      if (!source.is_valid(from.y, from.x)) continue;
      const float d = disparity.at(from.y, from.x);
      const float ty = std::round(static_cast<float>(y) - d * static_cast<float>(step.v));
      const float tx = std::round(static_cast<float>(x) - d * static_cast<float>(step.u));
      const bool is_inside = ty >= 0 && ty < static_cast<float>(disparity.height) && tx >= 0 &&
                             tx < static_cast<float>(disparity.width);
      if (!is_inside) continue;
      float& held = nearest.at(static_cast<int>(ty), static_cast<int>(tx));
      if (!(held >= d)) held = d;
    }
  }
  return nearest;
}

/// What a pixel between a and b should hold if these are parts of one surface in front of it.
float bridged(float a, float b, float held, float tolerance) {
  const bool is_surface = std::abs(a - b) <= tolerance;
  const bool is_behind = !(held >= std::min(a, b) - tolerance);
  return is_surface && is_behind ? (a + b) / 2 : held;
}

Image<float> close_cracks(const Image<float>& map, float tolerance) {
  Image<float> closed = map;
  for (int y = 0; y < map.height(); ++y) {
    for (int x = 0; x < map.width(); ++x) {
      float& held = closed.at(y, x);
      if (x > 0 && x + 1 < map.width()) {
        held = bridged(map.at(y, x - 1), map.at(y, x + 1), held, tolerance);
      }
      if (y > 0 && y + 1 < map.height()) {
        held = bridged(map.at(y - 1, x), map.at(y + 1, x), held, tolerance);
      }
    }
  }
  return closed;
}

}  // namespace

Image<float> warp_disparity(const DisparityView& source, ViewIndex step, double tolerance_px) {
  const Image<float> moved = splat(source, step);
  return step == ViewIndex{} ? moved : close_cracks(moved, static_cast<float>(tolerance_px));
}

}  // namespace episcope
