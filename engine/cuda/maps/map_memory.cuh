// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/array/indices.h"
#include "engine/cuda/device/device_array.cuh"
#include "engine/cuda/maps/device_maps.h"

namespace episcope::cuda {

/// What DeviceMaps holds, `[v][u][y][x]`.
struct MapMemory {
  explicit MapMemory(const ViewStack<float>& like)
      : grid(like.grid()),
        first(like.first()),
        disparity(like.size(), stream),
        confidence(like.size(), stream) {}

  DeviceStream stream;
  GridShape grid;
  ViewIndex first;
  DeviceArray<float> disparity, confidence;
};

}  // namespace episcope::cuda
