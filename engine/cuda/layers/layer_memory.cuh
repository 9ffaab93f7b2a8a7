// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/cuda/device/device_array.cuh"

#include <cstdint>

namespace episcope::cuda {

/// What DeviceLayers holds, `[v][u][y][x]`; `confidence` in 1/255.
struct LayerMemory {
  LayerMemory(std::size_t pixels, const DeviceStream& stream)
      : near(pixels, stream), far(pixels, stream), confidence(pixels, stream) {}

  DeviceArray<float> near, far;
  DeviceArray<std::uint8_t> confidence;
};

}  // namespace episcope::cuda
