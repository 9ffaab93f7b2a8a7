// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/cuda/tensor/orientations.h"
#include "engine/disparity/tensor/structure_tensor.h"

namespace episcope {

/// What the structure tensor with these scales looks for in this light field, for the device: both
/// directions, where the grid has them; how estimates are merged is left open. Throws InvalidInput
/// as StructureTensor.
[[nodiscard]] cuda::TensorSettings device_tensor_settings(const LightField& light_field,
                                                          const TensorScales& scales,
                                                          const TensorSearch& search);

}  // namespace episcope
