// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/image.h"
#include "engine/core/progress.h"
#include "engine/cuda/device.h"

#include <cstdint>

namespace episcope::cuda {

/// Costs of a volume around one label of each pixel, `[y][x]`: of the label before, of the label,
/// of the one after (the label's own at the ends), and the mean over all.
struct CostsAtLabels {
  Image<float> before, here, after, mean;
};
/// Throws DeviceFailure, Cancelled.
[[nodiscard]] CostsAtLabels costs_at_labels(const DeviceVolume& volume, const Image<int>& labels,
                                            const Progress& progress);

/// The label of least cost at each pixel, of equals the lowest. Throws DeviceFailure, Cancelled.
[[nodiscard]] Image<int> least_labels(const DeviceVolume& volume, const Progress& progress);

/// The sum over the valid pixels of the mean cost of the labels within `reach` of a pixel's best
/// one; see cost_unit. `valid` `[y][x]` is on the host, null = all. Throws DeviceFailure,
/// Cancelled.
[[nodiscard]] double sum_around_best(const DeviceVolume& volume, const std::uint8_t* valid,
                                     int reach, const Progress& progress);

}  // namespace episcope::cuda
