// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/scenes/stratified/layouts.h"

namespace episcope::scenes {

/// A strong random texture where a pixel has size `pixel_units`, without patterns that repeat.
[[nodiscard]] Texture strong_texture(Draw draw, double pixel_units);

/// The size of a pixel where a plane is farthest from the cameras: a texture that is resolved there
/// is resolved everywhere.
[[nodiscard]] double coarsest_pixel(const Stage& stage, const DisparityPlane& plane);

/// Disparity of a plane at a pixel of the centre view.
[[nodiscard]] double disparity_at(const Stage& stage, const DisparityPlane& plane, double x,
                                  double y);

/// Moves a primitive to the point of a plane that is seen at a pixel of the centre view.
void move_to(Primitive& primitive, const Stage& stage, const DisparityPlane& plane, double x,
             double y);

/// Noise that grows downwards, up to `least` … `most` units of 1/255.
[[nodiscard]] Sensor growing_noise(Draw draw, double least, double most);

/// The pixels for which `is_inside(y, x)` holds.
template <class IsInside>
Image<std::uint8_t> region_where(CenterLabels labels, IsInside is_inside) {
  Image<std::uint8_t> mask(labels.height, labels.width);
  for (int y = 0; y < labels.height; ++y) {
    for (int x = 0; x < labels.width; ++x) mask.at(y, x) = is_inside(y, x) ? 1 : 0;
  }
  return mask;
}

/// The pixels of one label.
[[nodiscard]] inline Image<std::uint8_t> region_of(CenterLabels labels, int label) {
  return region_where(labels, [&](int y, int x) { return labels.at(y, x) == label; });
}

}  // namespace episcope::scenes
