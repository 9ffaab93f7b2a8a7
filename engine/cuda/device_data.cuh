// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/indices.h"
#include "engine/core/light_field.h"
#include "engine/core/progress.h"
#include "engine/cuda/device.cuh"
#include "engine/cuda/device_data.h"

#include <cstdint>
#include <memory>

namespace episcope::cuda {

/// The samples of a light field on the device, for kernels: `[v][u][y][x][c]` in their stored type.
struct DeviceSamples {
  const void* samples = nullptr;
  const std::uint8_t* valid = nullptr;  ///< `[v][u][y][x]`, 0 = invalid; null = all valid.
  SampleType type = SampleType::UInt8;
  GridShape grid;
  int height = 0;
  int width = 0;
  int channels = 1;

  /// Elements before a pixel of a view, in pixels.
  [[nodiscard]] __host__ __device__ long pixel(int v, int u, int y, int x) const {
    return ((static_cast<long>(v) * grid.u + u) * height + y) * width + x;
  }
  /// A sample in [0, 1], rounded as LightField::read_row gives it.
  [[nodiscard]] __device__ float at(long pixel, int channel) const {
    const long index = pixel * channels + channel;
    switch (type) {
      case SampleType::UInt8:
        return __fmul_rn(1.0F / 255,
                         static_cast<float>(static_cast<const std::uint8_t*>(samples)[index]));
      case SampleType::UInt16:
        return __fmul_rn(1.0F / 65535,
                         static_cast<float>(static_cast<const std::uint16_t*>(samples)[index]));
      default:
        return static_cast<const float*>(samples)[index];
    }
  }
};

/// A light field on the device.
class DeviceLightField {
 public:
  /// Uploads. Throws DeviceFailure, Cancelled.
  DeviceLightField(const LightField& light_field, const Progress& progress);

  [[nodiscard]] const DeviceSamples& samples() const { return view_; }

 private:
  DeviceStream stream_;
  DeviceArray<std::uint8_t> samples_, valid_;
  DeviceSamples view_;
};

/// The light field on the device: uploaded when it is asked for first, kept until another takes its
/// place. Thread-safe. Throws DeviceFailure, Cancelled.
[[nodiscard]] std::shared_ptr<const DeviceLightField> on_device(const LightField& light_field,
                                                                const Progress& progress);

/// Disparity and confidence `[v][u][y][x]` of a rectangle of views, on the device. Views of the
/// light field are counted from its first, maps from that of the rectangle.
struct MapPointers {
  GridShape grid;
  ViewIndex first;
  float* disparity = nullptr;
  float* confidence = nullptr;

  /// Index of the map of view (v, u).
  [[nodiscard]] __host__ __device__ int index(int v, int u) const {
    return (v - first.v) * grid.u + (u - first.u);
  }
};

/// What DeviceMaps holds, `[v][u][y][x]`.
struct MapMemory {
  explicit MapMemory(const ViewStack<float>& like)
      : grid(like.grid()),
        first(like.first()),
        disparity(like.size(), stream),
        confidence(like.size(), stream) {}

  /// Data of all stages.
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
