// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/cuda/device/device_volume.cuh"

namespace episcope::cuda {

/// Divides the costs of every pixel by its cap, `[y][x]`, and multiplies them by `mean`.
void divide_by_caps(DeviceVolume& costs, const float* caps, float mean, const DeviceStream& stream);

}  // namespace episcope::cuda
