// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/array/volume.h"
#include "engine/core/parallel/progress.h"

#include <memory>

namespace episcope::cuda {

/// A volume `[y][layer][x]` in the memory of the device (device_volume.cuh), complete and
/// immutable.
struct DeviceVolume;
using SharedVolume = std::shared_ptr<const DeviceVolume>;

/// Copies a volume to the device. Throws DeviceFailure, Cancelled.
[[nodiscard]] SharedVolume upload_volume(VolumeView<const float> volume, const Progress& progress);

}  // namespace episcope::cuda
