// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/kernels/double_orientation_kernel.h"

#include "engine/core/simd.h"
#include "engine/disparity/kernels/shared_constants.h"

// Compiled once for each instruction set: see engine/core/isa.h for what may stand here.

namespace episcope::EPISCOPE_KERNEL_NAMESPACE {
namespace {

constexpr int kMaxChannels = 3;

// Even filters take the sum of two neighbors, the odd one their difference.
template <int kRadius>
void differentiate_plane(const float* __restrict in, long lanes, int along,
                         const SecondOrderFilters& filters, float* __restrict const* out) {
  const float* const even = filters.along[0].values + kRadius;
  const float* const odd = filters.along[1].values + kRadius;
  const float* const second = filters.along[2].values + kRadius;
  for (long n = 0; n < lanes; n += kLanes) {
    const Vec here = load(in + n);
    Vec sums[3] = {even[0] * here, Vec{}, second[0] * here};
    for (int i = 1; i <= kRadius; ++i) {
      const Vec after = load(in + n + static_cast<long>(i) * along);
      const Vec before = load(in + n - static_cast<long>(i) * along);
      const Vec both = after + before;
      sums[0] += even[i] * both;
      sums[1] += odd[i] * (after - before);
      sums[2] += second[i] * both;
    }
    for (int j = 0; j < 3; ++j) store(out[j] + n, sums[j]);
  }
}

void differentiate(const DoubleBlock& block, const SecondOrderFilters& filters) {
  for (int plane = 0; plane < block.channels * block.rows; ++plane) {
    const long at = plane * block.pitch;
    float* const out[3] = {block.derivative[0] + at, block.derivative[1] + at,
                           block.derivative[2] + at};
    with_radius<1>(filters.along[0].radius, [&]<int kRadius>() {
      differentiate_plane<kRadius>(block.samples + at, block.lanes, block.along, filters, out);
    });
  }
}

// Where the views of one filter are read: the line of disparity `step` through a product row moves
// by −step for each view.
struct Sources {
  const float* order[3][kMaxChannels];
  long step = 0;  // lanes from one view of the filter to the next
};

Sources sources_of(const DoubleBlock& block, int row, int step) {
  Sources sources;
  for (int j = 0; j < 3; ++j) {
    for (int c = 0; c < block.channels; ++c) {
      sources.order[j][c] =
          block.derivative[j] + (static_cast<long>(c) * block.rows + row) * block.pitch;
    }
  }
  sources.step = block.pitch - static_cast<long>(step) * block.along;
  return sources;
}

// A product that an invalid sample entered, NaN, counts nothing.
template <bool kHasInvalid>
inline Vec known_or_zero(Vec product) {
  if constexpr (kHasInvalid) return choose(product == product, product, Vec{});
  return product;
}

// Products of the whitened derivatives at one vector of lanes, channels summed, toned down.
template <int kRadius, int kChannels, bool kHasInvalid>
void multiply_row(const Sources& from, const SecondOrderFilters& filters, long begin, long end,
                  float* __restrict const* out) {
  const float* const even = filters.views[0].values + kRadius;
  const float* const odd = filters.views[1].values + kRadius;
  const float* const second = filters.views[2].values + kRadius;
  for (long n = begin; n < end; n += kLanes) {
    Vec sums[6] = {};
    for (int c = 0; c < kChannels; ++c) {
      Vec xx = even[0] * load(from.order[2][c] + n);
      Vec xu{};
      Vec uu = second[0] * load(from.order[0][c] + n);
      for (int i = 1; i <= kRadius; ++i) {
        const long ahead = n + i * from.step;
        const long behind = n - i * from.step;
        xx += even[i] * (load(from.order[2][c] + ahead) + load(from.order[2][c] + behind));
        xu += odd[i] * (load(from.order[1][c] + ahead) - load(from.order[1][c] + behind));
        uu += second[i] * (load(from.order[0][c] + ahead) + load(from.order[0][c] + behind));
      }
      const Vec third = filters.scale[2] * uu + filters.mix * xx;
      const Vec first = filters.scale[0] * xx;
      const Vec middle = filters.scale[1] * xu;
      sums[0] += first * first;
      sums[1] += first * middle;
      sums[2] += first * third;
      sums[3] += middle * middle;
      sums[4] += middle * third;
      sums[5] += third * third;
    }
    // As in the first-order tensor: a silhouette must not drown the texture beside it.
    const Vec weight =
        filters.contrast_energy * reciprocal(sums[0] + sums[3] + sums[5] + filters.contrast_energy);
    for (int j = 0; j < 6; ++j) store(out[j] + n, known_or_zero<kHasInvalid>(weight * sums[j]));
  }
}

template <int kRadius>
void filter_plane(const float* __restrict in, long begin, long end, long stride, const Taps& taps,
                  float* __restrict out) {
  const float* const weights = taps.values + kRadius;
  for (long n = begin; n < end; n += kLanes) {
    Vec sum = weights[0] * load(in + n);
    for (int i = 1; i <= kRadius; ++i) {
      sum += weights[i] * (load(in + n + i * stride) + load(in + n - i * stride));
    }
    store(out + n, sum);
  }
}

void filter(const float* in, long begin, long end, long stride, const Taps& taps, float* out) {
  with_radius(taps.radius,
              [&]<int kRadius>() { filter_plane<kRadius>(in, begin, end, stride, taps, out); });
}

template <bool kHasInvalid>
auto multiply_row_of(int radius, int channels) {
  if (radius == 1) {
    return channels == 1 ? multiply_row<1, 1, kHasInvalid> : multiply_row<1, 3, kHasInvalid>;
  }
  return channels == 1 ? multiply_row<2, 1, kHasInvalid> : multiply_row<2, 3, kHasInvalid>;
}

void accumulate(const DoubleBlock& block, const SecondOrderFilters& filters, int step) {
  const int radius = filters.views[0].radius;
  const auto run = block.has_invalid ? multiply_row_of<true>(radius, block.channels)
                                     : multiply_row_of<false>(radius, block.channels);
  for (int row = block.first_product; row < block.last_product; ++row) {
    const long plane = (row - block.first_product) * block.pitch;
    float* out[6];
    for (int j = 0; j < 6; ++j) out[j] = block.product[j] + plane;
    run(sources_of(block, row, step), filters, 0, block.lanes, out);
    for (float* product : out) {
      filter(product, 0, block.lanes, block.along, filters.integrate, block.scratch);
      filter(block.scratch, 0, block.lanes, block.across, filters.across, product);
    }
  }
}

// The tensor of 6 products and what its smallest eigenvector says.
struct Answer {
  Vec mean, half_distance, confidence;
  IntVec is_real;
};

// Newton's steps on the characteristic polynomial from 0, which rise monotonically to the smallest
// of three eigenvalues that are all ≥ 0: no angle, no loss by cancellation in a closed form.
inline Vec smallest_eigenvalue(Vec minors, Vec determinant) {
  Vec value{};
  for (int i = 0; i < 5; ++i) {
    const Vec p = ((value - 1.0F) * value + minors) * value - determinant;
    const Vec slope = (3.0F * value - 2.0F) * value + minors;
    value = greatest(value - p / greatest(slope, splat(kMinorsFloor)), Vec{});
  }
  return value;
}

inline Answer solve(const Vec* products, const SecondOrderFilters& filters) {
  const Vec trace = products[0] + products[3] + products[5] + 1e-20F;
  const Vec inverse = 1.0F / trace;
  Vec t[6];
  for (int j = 0; j < 6; ++j) t[j] = inverse * products[j];
  const Vec minors =
      t[0] * t[3] - t[1] * t[1] + (t[0] * t[5] - t[2] * t[2]) + (t[3] * t[5] - t[4] * t[4]);
  const Vec determinant = t[0] * (t[3] * t[5] - t[4] * t[4]) - t[1] * (t[1] * t[5] - t[2] * t[4]) +
                          t[2] * (t[1] * t[4] - t[2] * t[3]);
  const Vec smallest = smallest_eigenvalue(greatest(minors, Vec{}), determinant);
  // The other two: their sum is 1 − smallest, their product what is left of the minors.
  const Vec sum = 1.0F - smallest;
  const Vec product = greatest(minors - smallest * sum, Vec{});
  const Vec root = square_root(greatest(sum * sum - 4.0F * product, Vec{}));
  const Vec middle = 2.0F * product / (sum + root + 1e-20F);
  // Its eigenvector is any column of the adjoint of T − λ: the longest is the safest.
  const Vec a = t[0] - smallest, d = t[3] - smallest, f = t[5] - smallest;
  const Vec c11 = d * f - t[4] * t[4], c22 = a * f - t[2] * t[2], c33 = a * d - t[1] * t[1];
  const Vec c12 = t[2] * t[4] - t[1] * f, c13 = t[1] * t[4] - t[2] * d;
  const Vec c23 = t[1] * t[2] - a * t[4];
  const IntVec third = (c33 >= c11) & (c33 >= c22);
  const IntVec second = c22 >= c11;
  const Vec b1 = choose(third, c13, choose(second, c12, c11));
  const Vec b2 = choose(third, c23, choose(second, c22, c12));
  const Vec b3 = choose(third, c33, choose(second, c23, c13));
  // Back from whitened derivatives: Q f_xx − S f_xu + f_uu = 0.
  const Vec last = filters.scale[2] * b3;
  const IntVec is_sound = b3 * b3 > 1e-4F * (b1 * b1 + b2 * b2 + b3 * b3);
  const Vec inverse_last = 1.0F / choose(is_sound, last, splat(1));
  const Vec mean = -0.5F * filters.scale[1] * b2 * inverse_last;
  const Vec both = (filters.scale[0] * b1 + filters.mix * b3) * inverse_last;
  const Vec discriminant = mean * mean - both;
  Answer answer;
  answer.mean = mean;
  answer.half_distance = square_root(greatest(discriminant, Vec{}));
  answer.is_real = is_sound & (discriminant > 0.0F) & (minors > kMinorsFloor);
  // Two orientations leave the third eigenvalue empty, one leaves the second empty as well.
  const Vec strength = middle * trace;
  answer.confidence = greatest(1.0F - smallest / (middle + 1e-20F), Vec{}) * strength /
                      (strength + filters.noise_energy + 1e-20F);
  return answer;
}

void select(const DoubleBlock& block, const SecondOrderFilters& filters, const DoubleShear& shear,
            const DoubleRun& run) {
  const int product_rows = block.last_product - block.first_product;
  const float* const weights = filters.row_weights + static_cast<long>(run.row) * product_rows;
  const auto step = static_cast<float>(shear.step);
  for (int n = 0; n < run.count; n += kLanes) {
    Vec products[6] = {};
    for (int i = 0; i < product_rows; ++i) {
      if (weights[i] == 0) continue;
      const long moved = static_cast<long>(shear.step) * (block.first_product + i - run.row);
      const long from = i * block.pitch + run.begin + n - moved * block.along;
      for (int j = 0; j < 6; ++j) products[j] += weights[i] * load(block.product[j] + from);
    }
    const Answer answer = solve(products, filters);
    const Vec near = answer.mean + answer.half_distance + step;
    const Vec far = answer.mean - answer.half_distance + step;
    const Vec so_far = load(run.confidence + n);
    const IntVec better = answer.is_real & (absolute(answer.mean) <= shear.limit) &
                          (answer.half_distance >= 0.5F * shear.min_distance) &
                          (near <= shear.max) & (far >= shear.min) & (answer.confidence > so_far);
    store(run.near + n, choose(better, near, load(run.near + n)));
    store(run.far + n, choose(better, far, load(run.far + n)));
    store(run.confidence + n, choose(better, answer.confidence, so_far));
  }
}

}  // namespace

extern const DoubleOrientationKernel kDoubleOrientationKernel;
const DoubleOrientationKernel kDoubleOrientationKernel{differentiate, accumulate, select};

}  // namespace episcope::EPISCOPE_KERNEL_NAMESPACE
