// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/cuda/device/device_array.cuh"
#include "engine/cuda/device/device_volume.h"

namespace episcope::cuda {

/// Whoever makes one waits for its stream before others see it.
struct DeviceVolume {
  DeviceStream stream;
  int height = 0, layers = 0, width = 0;
  DeviceArray<float> values;  ///< `[y][layer][x]`

  DeviceVolume(int rows, int labels, int columns)
      : height(rows),
        layers(labels),
        width(columns),
        values(static_cast<std::size_t>(rows) * labels * columns, stream) {}
  [[nodiscard]] VolumeView<const float> view() const {
    return {values.data(), height, layers, width};
  }
};

}  // namespace episcope::cuda
