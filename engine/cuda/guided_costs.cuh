// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/cuda/device.cuh"
#include "engine/cuda/device_data.cuh"
#include "engine/cuda/stereo_matcher.h"

namespace episcope::cuda {

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

/// The position of the minimum between labels, as `sub_label_offset`.
__device__ inline float offset_between(float before, float here, float after,
                                       LabelPlaces::Refinement refinement) {
  using enum LabelPlaces::Refinement;
  const float bend =
      refinement == Parabola ? before - 2 * here + after : fmaxf(before, after) - here;
  if (refinement == None || !(bend > 0)) return 0;
  return fminf(fmaxf(0.5F * (before - after) / bend, -0.5F), 0.5F);
}

/// Disparity and confidence `[row][x]` of rows of costs `[row][label][x]`.
void choose_winners(VolumeView<const float> costs, const LabelPlaces& places, float* disparity,
                    float* confidence, const DeviceStream& stream);

}  // namespace episcope::cuda
