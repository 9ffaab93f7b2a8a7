// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/cuda/layers/double_layers.h"
#include "engine/disparity/layers/double_orientation.h"

#include <vector>

namespace episcope {

/// What the device needs to measure two orientations as DoubleOrientation does.
struct DevicePasses {
  std::vector<cuda::DoublePass> passes;  ///< Of the directions that have enough views.
  cuda::DoubleShears shears;
};

[[nodiscard]] DevicePasses device_passes(const LightField& light_field, const TensorScales& scales,
                                         const DoubleSearch& search);

}  // namespace episcope
