// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/cuda/light_field/device_light_field.cuh"

namespace episcope::cuda {

inline constexpr int kMaxDeviceGuidedRadius = 8;

/// A GuideImage on the device: planes `[plane][y][x]`, in its order.
struct DeviceGuide {
  const float* planes = nullptr;
  int radius = 0;
  int height = 0, width = 0, channels = 0;

  [[nodiscard]] __device__ const float* plane(int i) const {
    return planes + static_cast<long>(i) * height * width;
  }
};

/// The planes of a guide.
[[nodiscard]] DeviceArray<float> make_guide_planes(const DeviceSamples& samples, ViewIndex view,
                                                   int radius, double regularization,
                                                   const DeviceStream& stream);

/// Rows of costs `[row][label][x]`: row 0 is row `first` of the guide.
struct CostRows {
  int first = 0;
  int rows = 0;
  int labels = 0;
};

/// Filters every label: `filtered`, rows `to`, from `costs`, rows `from`, which reach 2·radius rows
/// farther on both sides, as far as the image does.
void filter_costs(const DeviceGuide& guide, const CostRows& from, const float* costs,
                  const CostRows& to, float* filtered, const DeviceStream& stream);

}  // namespace episcope::cuda
