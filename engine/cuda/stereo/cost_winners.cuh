// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/cuda/device/device_stream.cuh"
#include "engine/cuda/stereo/stereo_matcher.h"

namespace episcope::cuda {

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
