// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/parallel/progress.h"
#include "engine/cuda/light_field/device_light_field.cuh"
#include "engine/cuda/tensor/orientations.h"

#include <functional>

namespace episcope::cuda {

/// Disparity and coherence `[v][u][y][x]` of a rectangle of views, on the device.
struct OrientationMaps {
  GridShape grid;
  ViewIndex first;
  float* disparity = nullptr;
  float* confidence = nullptr;
  /// Maps of a view.
  [[nodiscard]] __host__ __device__ int index(int v, int u) const {
    return (v - first.v) * grid.u + (u - first.u);
  }
};

/// Told that maps [first, first + count) will be done when what the stream was told so far is.
using MapsBegun = std::function<void(int first, int count)>;

/// `find_orientations` of what is on the device, on a stream, with the results left there.
/// `on_maps` hears of every map once. Throws DeviceFailure, Cancelled.
void find_orientations_on_device(const DeviceSamples& samples, const TensorSettings& settings,
                                 const OrientationMaps& maps, const DeviceStream& stream,
                                 const Progress& progress, const MapsBegun& on_maps = {});

}  // namespace episcope::cuda
