// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/array/indices.h"
#include "engine/cuda/light_field/device_light_field.cuh"
#include "engine/cuda/maps/device_maps.h"
#include "engine/cuda/maps/map_pointers.cuh"

namespace episcope::cuda {

/// What DeviceMaps holds, `[v][u][y][x]`.
struct MapMemory {
  explicit MapMemory(const ViewStack<float>& like)
      : grid(like.grid()),
        first(like.first()),
        disparity(like.size(), stream),
        confidence(like.size(), stream) {}

  /// The same for all stages.
  [[nodiscard]] const DeviceSamples& samples(const LightField& lf, const Progress& progress) {
    if (!light_field) light_field = on_device(lf, progress.part(0, 0));
    return light_field->samples();
  }

  [[nodiscard]] MapPointers pointers() {
    return {grid, first, disparity.data(), confidence.data()};
  }

  std::shared_ptr<const DeviceLightField> light_field;  // outlives what the stream does with it
  DeviceStream stream;
  GridShape grid;
  ViewIndex first;
  DeviceArray<float> disparity, confidence;
};

}  // namespace episcope::cuda
