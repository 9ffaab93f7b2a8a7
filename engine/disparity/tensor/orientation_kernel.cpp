// SPDX-License-Identifier: BSD-3-Clause
// Compiled once for each instruction set: see engine/core/parallel/isa.h for what may stand here.
#include "engine/core/parallel/simd.h"
#include "engine/disparity/tensor/structure_tensor_kernel.h"

namespace episcope::EPISCOPE_KERNEL_NAMESPACE {
namespace {

// Taps are symmetric: both samples of a pair are added first, on adders that multiplications leave
// idle.
template <int kCount>
inline Vec integrate_at(const float* in, int stride, const Vec* taps) {
  Vec sum = taps[0] * (load(in) + load(in + (kCount - 1) * stride));
  if constexpr (kCount == 1) return taps[0] * load(in);
  for (int i = 1; i < kCount / 2; ++i) {
    sum += taps[i] * (load(in + i * stride) + load(in + (kCount - 1 - i) * stride));
  }
  if constexpr (kCount % 2 == 1) sum += taps[kCount / 2] * load(in + kCount / 2 * stride);
  return sum;
}

// |d| < 1 lies below a bound b exactly if tan 2θ does: with d = −tan θ and tan 2θ = 2Jxs/(Jxx −
// Jss), d ≤ b means −2Jxs ≤ 2b/(1 − b²)·(Jxx − Jss), Jxx > Jss. No root, no division.
inline float double_angle(float bound) {
  return 2 * bound / (1 - bound * bound);
}

// Bounds of the disparity that remains after a shear.
struct Bounds {
  float below, above;
};

Bounds bounds_of(const Shear& shear) {
  const float upright = 0.5F * static_cast<float>(shear.half_steps);
  const float low = shear.min - upright;
  const float high = shear.max - upright;
  return {double_angle(low > -shear.limit ? low : -shear.limit),
          double_angle(high < shear.limit ? high : shear.limit)};
}

// Keeps the tensor of the most coherent shear; coherence is compared squared:
// r² = ((Jxx − Jss)² + 4Jxs²)/(Jxx + Jss + n²)² (Bigün and Granlund 1987).
template <int kCount>
void select_row(const float* const* tensor, int stride, const float* values, float noise_energy,
                const Shear& shear, int length, float* __restrict const* best) {
  Vec taps[kCount];
  for (int i = 0; i < kCount; ++i) taps[i] = splat(values[i]);
  const Vec upright = splat(0.5F * static_cast<float>(shear.half_steps));
  const Bounds bounds = bounds_of(shear);
  for (int n = 0; n < length; n += kLanes) {
    const Vec xx = integrate_at<kCount>(tensor[0] + n, stride, taps);
    const Vec ss = integrate_at<kCount>(tensor[2] + n, stride, taps);
    const Vec xs = integrate_at<kCount>(tensor[1] + n, stride, taps);
    const Vec difference = xx - ss;
    const Vec twice = -2.0F * xs;
    const IntVec within = (difference > 0.0F) & (twice >= bounds.below * difference) &
                          (twice <= bounds.above * difference);
    // A shear far from the disparities here: mostly no lane is within its bounds.
    if (!any(within)) continue;
    const Vec whole = xx + ss + (noise_energy + 1e-20F);
    const Vec coherence = (difference * difference + twice * twice) * reciprocal(whole * whole);
    const Vec so_far = load(best[3] + n);
    const IntVec better = within & (coherence > so_far);
    if (!any(better)) continue;
    // Back to unsheared coordinates: ∂s = ∂s' − k ∂x.
    const Vec unsheared_xs = xs - upright * xx;
    const Vec unsheared_ss = ss - upright * (xs + unsheared_xs);
    store(best[0] + n, choose(better, xx, load(best[0] + n)));
    store(best[1] + n, choose(better, unsheared_xs, load(best[1] + n)));
    store(best[2] + n, choose(better, unsheared_ss, load(best[2] + n)));
    store(best[3] + n, choose(better, coherence, so_far));
  }
}

using SelectRow = void (*)(const float* const* tensor, int stride, const float* taps,
                           float noise_energy, const Shear& shear, int length,
                           float* __restrict const* best);
// By the number of taps.
constexpr SelectRow kSelectRows[] = {nullptr,        select_row<1>,  select_row<2>,  select_row<3>,
                                     select_row<4>,  select_row<5>,  select_row<6>,  select_row<7>,
                                     select_row<8>,  select_row<9>,  select_row<10>, select_row<11>,
                                     select_row<12>, select_row<13>, select_row<14>};
static_assert(sizeof(kSelectRows) / sizeof(SelectRow) == kMaxTaps + 2);

void select(const TensorBlock& block, const TensorFilters& filters, const Shear& shear) {
  for (int r = block.first_row; r < block.last_row; ++r) {
    // The payload pixel x of row r stands at x + k·(r − center) of the sheared coordinates.
    const int half_steps = shear.half_steps * (r - shear.center_row);
    const bool half = (half_steps & 1) != 0;
    const Taps& taps = half ? filters.integrate_half : filters.integrate;
    const long from =
        static_cast<long>(r) * block.tensor_pitch + block.tensor_margin +
        static_cast<long>(floor_half(half_steps) - filters.integrate.radius) * block.stride;
    const long to = static_cast<long>(r) * block.best_pitch;
    const float* const tensor[3] = {block.tensor[0] + from, block.tensor[1] + from,
                                    block.tensor[2] + from};
    float* const best[4] = {block.best[0] + to, block.best[1] + to, block.best[2] + to,
                            block.best[3] + to};
    kSelectRows[2 * filters.integrate.radius + (half ? 2 : 1)](
        tensor, block.stride, taps.values, filters.noise_energy, shear, block.length, best);
  }
}

// The slope of ∂s + d ∂x = 0, −d, of one tensor by least squares.
inline Vec slope_of(const float* const* tensor, int n) {
  return load(tensor[1] + n) * reciprocal(load(tensor[0] + n) + 1e-20F);
}

// Neighbours whose disparity differs by so much, squared, count half: they see another surface.
constexpr float kDisagreement = 0.09F;

// K/(K + (slope − own)²), K as above, with slope = Jxs/Jxx: one division for both.
inline Vec agreement(Vec xx, Vec xs, Vec own) {
  const Vec off = xs - own * xx;
  const Vec agreeing = kDisagreement * (xx * xx) + 1e-30F;
  return agreeing * reciprocal(agreeing + off * off);
}

// Least squares of ∂s + d ∂x = 0 over the averaged tensor; coherence in the frame sheared by d.
void resolve(const TensorAverage& average) {
  const int middle = average.count / 2;
  for (int n = 0; n < average.length; n += kLanes) {
    Vec sum[3];
    for (int j = 0; j < 3; ++j)
      sum[j] = average.weights[middle] * load(average.tensor[middle][j] + n);
    const Vec own = slope_of(average.tensor[middle], n);
    for (int i = 0; i < average.count; ++i) {
      if (i == middle) continue;
      const Vec tensor[3] = {load(average.tensor[i][0] + n), load(average.tensor[i][1] + n),
                             load(average.tensor[i][2] + n)};
      const Vec weight = average.weights[i] * agreement(tensor[0], tensor[1], own);
      for (int j = 0; j < 3; ++j) sum[j] += weight * tensor[j];
    }
    const Vec xx = sum[0] + 1e-20F;
    const Vec disparity = -sum[1] * reciprocal(xx);
    Vec residual = sum[2] + disparity * sum[1];
    residual = choose(residual > 0.0F, residual, splat(0));
    Vec coherence = (xx - residual) * reciprocal(xx + residual + average.noise_energy);
    const IntVec inside = (disparity >= average.min) & (disparity <= average.max);
    coherence = choose(inside & (coherence > 0.0F), coherence, splat(0));
    const Vec above = choose(disparity < average.min, splat(average.min), disparity);
    store(average.disparity + n, choose(above > average.max, splat(average.max), above));
    store(average.coherence + n, coherence);
  }
}

inline Vec raised(Vec base, int power) {
  Vec result = splat(1);
  for (; power > 0; power >>= 1) {
    if ((power & 1) != 0) result *= base;
    base *= base;
  }
  return result;
}

// Directions that agree within this many px are averaged.
constexpr float kAgreement = 0.3F;

inline void merge_at(const float* disparity, const float* coherence, int power, float* to_disparity,
                     float* to_coherence) {
  const Vec here = load(coherence);
  const Vec there = load(to_coherence);
  const Vec value = load(disparity);
  const Vec other = load(to_disparity);
  const IntVec agree = (absolute(value - other) < kAgreement) & (here > 0.0F) & (there > 0.0F);
  const Vec weight = raised(here, power);
  const Vec share = weight / (weight + raised(there, power) + 1e-30F);
  const Vec winner = choose(here > there, value, other);
  store(to_disparity, choose(agree, other + share * (value - other), winner));
  store(to_coherence, choose(here > there, here, there));
}

void merge(const float* disparity, const float* coherence, int count, int power,
           float* to_disparity, float* to_coherence) {
  int n = 0;
  for (; n + kLanes <= count; n += kLanes) {
    merge_at(disparity + n, coherence + n, power, to_disparity + n, to_coherence + n);
  }
  if (n == count) return;
  // The rest through a padded copy: what lies behind belongs to others.
  float rest[4][kLanes] = {};
  for (int i = n; i < count; ++i) {
    rest[0][i - n] = disparity[i];
    rest[1][i - n] = coherence[i];
    rest[2][i - n] = to_disparity[i];
    rest[3][i - n] = to_coherence[i];
  }
  merge_at(rest[0], rest[1], power, rest[2], rest[3]);
  for (int i = n; i < count; ++i) {
    to_disparity[i] = rest[2][i - n];
    to_coherence[i] = rest[3][i - n];
  }
}

}  // namespace

extern const OrientationKernel kOrientationKernel;
const OrientationKernel kOrientationKernel{select, resolve, merge};

}  // namespace episcope::EPISCOPE_KERNEL_NAMESPACE
