// SPDX-License-Identifier: BSD-3-Clause
// Compiled once for each instruction set: see engine/core/parallel/isa.h for what may stand here.
#include "engine/disparity/tensor/eigenvector_kernel.h"

#include "engine/core/parallel/simd.h"

namespace episcope::EPISCOPE_KERNEL_NAMESPACE {
namespace {

// Keeps divisions by zero out where there is no texture.
constexpr float kTiny = 1e-20F;

// One row of a shear: its tensors where the first tap of the first lane falls, and the best so far.
struct SearchedRow {
  const float* tensor[3];
  float* best[4];
  const float* taps;
  int count;
};

SearchedRow row_of(const TensorBlock& block, const TensorFilters& filters, const Shear& shear,
                   int row) {
  const int half_steps = shear.half_steps * (row - shear.center_row);
  const bool half = (half_steps & 1) != 0;
  const int radius = filters.integrate.radius;
  const long from = static_cast<long>(row) * block.tensor_pitch + block.tensor_margin +
                    static_cast<long>(floor_half(half_steps) - radius) * block.stride;
  SearchedRow searched{};
  for (int j = 0; j < 3; ++j) searched.tensor[j] = block.tensor[j] + from;
  for (int j = 0; j < 4; ++j) {
    searched.best[j] = block.best[j] + static_cast<long>(row) * block.best_pitch;
  }
  searched.taps = half ? filters.integrate_half.values : filters.integrate.values;
  searched.count = 2 * radius + (half ? 2 : 1);
  return searched;
}

struct Tensor {
  Vec xx, xs, ss;
};

inline Vec integrate_at(const SearchedRow& row, int plane, int n, int stride) {
  Vec sum = row.taps[0] * load(row.tensor[plane] + n);
  for (int i = 1; i < row.count; ++i) {
    sum += row.taps[i] * load(row.tensor[plane] + n + i * stride);
  }
  return sum;
}

// Back to unsheared coordinates: ∂s = ∂s' − k ∂x.
inline Tensor unsheared(const Tensor& tensor, Vec k) {
  const Vec xs = tensor.xs - k * tensor.xx;
  return {tensor.xx, xs, tensor.ss - k * (tensor.xs + xs)};
}

// The tensor with eigenvalues (trace ± root)/2 whose residual along d is the smaller of them.
inline Tensor of_eigenvector(Vec trace, Vec root, Vec d) {
  const Vec large = 0.5F * (trace + root);
  const Vec xs = -d * large;
  return {large, xs, 0.5F * (trace - root) - d * xs};
}

void select_row(const SearchedRow& row, const TensorBlock& block, float noise_energy,
                const Shear& shear, bool replace) {
  const Vec upright = splat(0.5F * static_cast<float>(shear.half_steps));
  for (int n = 0; n < block.length; n += kLanes) {
    const Tensor tensor{integrate_at(row, 0, n, block.stride),
                        integrate_at(row, 1, n, block.stride),
                        integrate_at(row, 2, n, block.stride)};
    const Vec difference = tensor.xx - tensor.ss;
    const Vec twice = -2.0F * tensor.xs;
    const Vec trace = tensor.xx + tensor.ss;
    const Vec root = square_root(difference * difference + twice * twice);
    const Vec disparity = twice / (difference + root + kTiny);
    const Vec ratio = root / (trace + (noise_energy + kTiny));
    const Vec coherence = ratio * ratio;
    const Vec so_far = load(row.best[3] + n);
    const IntVec better =
        (disparity >= -shear.limit) & (disparity <= shear.limit) & (coherence > so_far);
    if (!any(better)) continue;
    const Tensor kept =
        unsheared(replace ? of_eigenvector(trace, root, disparity) : tensor, upright);
    store(row.best[0] + n, choose(better, kept.xx, load(row.best[0] + n)));
    store(row.best[1] + n, choose(better, kept.xs, load(row.best[1] + n)));
    store(row.best[2] + n, choose(better, kept.ss, load(row.best[2] + n)));
    store(row.best[3] + n, choose(better, coherence, so_far));
  }
}

void select(const TensorBlock& block, const TensorFilters& filters, const Shear& shear,
            bool replace) {
  for (int r = block.first_row; r < block.last_row; ++r) {
    select_row(row_of(block, filters, shear, r), block, filters.noise_energy, shear, replace);
  }
}

}  // namespace

extern const EigenvectorKernel kEigenvectorKernel;
const EigenvectorKernel kEigenvectorKernel{select};

}  // namespace episcope::EPISCOPE_KERNEL_NAMESPACE
