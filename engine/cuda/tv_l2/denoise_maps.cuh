// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/parallel/progress.h"
#include "engine/cuda/light_field/device_light_field.cuh"
#include "engine/cuda/tv_l2/tv_l2.h"

#include <vector>

namespace episcope::cuda {

/// The rectangle of views that maps `[v][u][y][x]` cover.
struct MappedViews {
  GridShape grid;
  ViewIndex first;
};

/// `denoise_maps` of what is on the device already, on a stream. Throws DeviceFailure, Cancelled.
[[nodiscard]] std::vector<double> denoise_on_device(const DeviceSamples& samples,
                                                    const MappedViews& views,
                                                    const MapDenoising& denoising,
                                                    const float* confidence, float* disparity,
                                                    const DeviceStream& stream,
                                                    const Progress& progress);

/// The weights of the data and of the variation for `count` views from number `first` on,
/// `[view][y][x]`: DataWeight with MapDenoising::map_noise, and smoothness_weights.
struct DenoisingWeights {
  float* data;
  float* edges;
};
void fill_weights(const DeviceSamples& samples, const MappedViews& views, int first, int count,
                  const MapDenoising& denoising, const float* confidence, const float* disparity,
                  const DenoisingWeights& weights, const DeviceStream& stream);

}  // namespace episcope::cuda
