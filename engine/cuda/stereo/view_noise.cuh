// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/cuda/light_field/device_light_field.cuh"

namespace episcope::cuda {

/// local_noise_variance of a view, `[y][x]`, at most `most`.
[[nodiscard]] DeviceArray<float> local_noise_on_device(const DeviceSamples& samples, ViewIndex view,
                                                       float most, const DeviceStream& stream);

}  // namespace episcope::cuda
