// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace episcope::cuda {

/// θ such that Σ_l max(v_l − θ, 0) = 1 of the values `stride` apart, `top` the largest of them; as
/// in simplex_labeling_kernel.cpp.
__device__ inline float simplex_threshold(const float* values, int stride, int layers, float top) {
  float theta = top - 1.0F;
  for (int pass = 0; pass < layers; ++pass) {
    float sum = -1, count = 0;
    for (int l = 0; l < layers; ++l) {
      const float over = values[l * stride] - theta;
      sum += fmaxf(over, 0.0F);
      count += over > 0.0F ? 1.0F : 0.0F;
    }
    theta += fmaxf(sum / fmaxf(count, 1.0F), 0.0F);
    if (!(sum > 1e-6F)) break;
  }
  return theta;
}

}  // namespace episcope::cuda
