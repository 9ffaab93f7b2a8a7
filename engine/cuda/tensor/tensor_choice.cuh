// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// The tensor of one ray, and the choice of the best of its shears.

#include "engine/cuda/tensor/best_tensors.cuh"
#include "engine/cuda/tensor/cpu_order.cuh"

namespace episcope::cuda {

struct Tensor {
  float xx, xs, ss;
};

__device__ inline void add(Tensor& sum, float weight, const Tensor& tensor) {
  sum.xx = __fmaf_rn(weight, tensor.xx, sum.xx);
  sum.xs = __fmaf_rn(weight, tensor.xs, sum.xs);
  sum.ss = __fmaf_rn(weight, tensor.ss, sum.ss);
}

/// Parts of a tensor lie `pitch` apart.
__device__ inline Tensor load(const float* from, long pitch) {
  return {from[0], from[pitch], from[2 * pitch]};
}
__device__ inline void store(const Tensor& tensor, float* to, long pitch) {
  to[0] = tensor.xx;
  to[pitch] = tensor.xs;
  to[2 * pitch] = tensor.ss;
}

/// Which tensors of a shear are accepted, and which is better; see OrientationKernel::select, and
/// for limits from 1 on EigenvectorKernel.
class ShearChoice {
 public:
  __device__ ShearChoice(const TensorSearchFilters& filters, int half_steps)
      : limit_(filters.limit),
        upright_(0.5F * static_cast<float>(half_steps)),
        noise_(filters.noise_energy),
        replaces_(filters.eigenvector),
        by_eigenvector_(filters.eigenvector || filters.limit >= 1) {
    if (by_eigenvector_) return;
    const float low = filters.min - upright_, high = filters.max - upright_;
    below_ = double_angle(low > -limit_ ? low : -limit_);
    above_ = double_angle(high < limit_ ? high : limit_);
  }

  /// Parts of the best, and its coherence squared, lie `pitch` apart.
  __device__ void keep_better(const Tensor& tensor, float* best, int pitch) const {
    if (by_eigenvector_) {
      keep_eigenvector(tensor, best, pitch);
    } else {
      keep_tensor(tensor, best, pitch);
    }
  }

  [[nodiscard]] __device__ bool by_eigenvector() const { return by_eigenvector_; }

 private:
  static constexpr float kTiny = 1e-20F;

  // |d| < 1 is at most b exactly if tan 2θ is.
  __device__ static float double_angle(float bound) { return 2 * bound / (1 - bound * bound); }

  // Back to unsheared coordinates: ∂s = ∂s' − k ∂x.
  __device__ void keep(const Tensor& tensor, float coherence, float* best, int pitch) const {
    const float xs = tensor.xs - upright_ * tensor.xx;
    store({tensor.xx, xs, tensor.ss - upright_ * (tensor.xs + xs)}, best, pitch);
    best[3 * pitch] = coherence;
  }

  __device__ void keep_tensor(const Tensor& tensor, float* best, int pitch) const {
    const float difference = tensor.xx - tensor.ss, twice = -2 * tensor.xs;
    if (!(difference > 0 && twice >= below_ * difference && twice <= above_ * difference)) return;
    const float whole = tensor.xx + tensor.ss + (noise_ + kTiny);
    const float coherence =
        two_products(difference, difference, twice, twice) * reciprocal(whole * whole);
    if (coherence > best[3 * pitch]) keep(tensor, coherence, best, pitch);
  }

  __device__ void keep_eigenvector(const Tensor& tensor, float* best, int pitch) const {
    const float difference = tensor.xx - tensor.ss, twice = -2 * tensor.xs;
    const float trace = tensor.xx + tensor.ss;
    const float root = sqrtf(two_products(difference, difference, twice, twice));
    const float disparity = twice / (difference + root + kTiny);
    const float ratio = root / (trace + (noise_ + kTiny));
    const float coherence = ratio * ratio;
    const bool is_better =
        disparity >= -limit_ && disparity <= limit_ && coherence > best[3 * pitch];
    if (!is_better) return;
    if (!replaces_) return keep(tensor, coherence, best, pitch);
    // Of eigenvalues (trace ± root)/2, the residual along d is the smaller one.
    const float large = 0.5F * (trace + root), xs = -disparity * large;
    keep({large, xs, two_products(0.5F, trace - root, -disparity, xs)}, coherence, best, pitch);
  }

  float limit_, upright_, noise_;
  bool replaces_, by_eigenvector_;
  float below_ = 0, above_ = 0;
};

}  // namespace episcope::cuda
