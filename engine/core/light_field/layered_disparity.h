// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/light_field/disparity_field.h"

#include <cstdint>

namespace episcope {

/// Further results of a method that estimates two layers (transparent scenes).
struct LayeredDisparity {
  DisparityField foreground;
  DisparityField background;
  ViewStack<std::uint8_t> layers;  ///< 1 or 2 surfaces per pixel; 0 = unknown.
};

}  // namespace episcope
