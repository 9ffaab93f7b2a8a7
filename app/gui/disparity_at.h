// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/disparity_field.h"

#include <optional>

namespace episcope {

/// Disparity of one pixel; none where the field does not cover the view or the pixel is invalid.
[[nodiscard]] inline std::optional<double> disparity_at(const DisparityField& field, ViewIndex view,
                                                        PixelIndex pixel) {
  if (!field.contains(view)) return std::nullopt;
  const DisparityView map = field.view(view);
  if (pixel.y >= map.disparity.height || pixel.x >= map.disparity.width) return std::nullopt;
  if (!map.is_valid(pixel.y, pixel.x)) return std::nullopt;
  return map.disparity.at(pixel.y, pixel.x);
}

}  // namespace episcope
