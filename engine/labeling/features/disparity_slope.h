// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/array/image.h"

namespace episcope {

/// How a surface is inclined, in px of disparity per px along each image axis, `[y][x]`.
struct DisparitySlopes {
  Image<float> x;
  Image<float> y;
};

/// Slopes of a map without holes, positive where disparity grows with x or y. Of the differences to
/// the pixels 3 and 6 px away on either side the one of least magnitude counts, so that a pixel
/// beside a jump has the slope of its own surface; what is narrower than 3 px has that of the jump.
/// A map smaller than that along an axis has slope 0 along it.
[[nodiscard]] DisparitySlopes disparity_slopes(ImageView<const float> disparity);

}  // namespace episcope
