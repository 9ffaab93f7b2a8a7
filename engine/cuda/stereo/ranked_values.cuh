// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/cuda/device/device_array.cuh"

#include <vector>

namespace episcope::cuda {

/// Of `count` values ≥ 0, infinite ones among them, those of these ranks in ascending order, each
/// rank in [0, count). Waits for the device. Throws DeviceFailure.
[[nodiscard]] std::vector<float> ranked_on_device(const float* values, int count,
                                                  const std::vector<int>& ranks,
                                                  const DeviceStream& stream);

/// The median as `quantile` has it, of at least one value.
[[nodiscard]] float median_on_device(const float* values, int count, const DeviceStream& stream);

}  // namespace episcope::cuda
