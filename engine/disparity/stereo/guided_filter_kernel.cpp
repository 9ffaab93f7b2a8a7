// SPDX-License-Identifier: BSD-3-Clause
// Compiled once for each instruction set: see engine/core/parallel/isa.h for what may stand here.
#include "engine/disparity/stereo/guided_filter_kernel.h"

#include "engine/core/parallel/simd.h"

namespace episcope::EPISCOPE_KERNEL_NAMESPACE {
namespace {

// Sums of `padded`, whose payload begins at lane `radius` between zeros, over 2·radius + 1 lanes.
void sum_along(const GuideRow& row, float* padded, float* out) {
  for (int x = 0; x < row.radius; ++x) padded[x] = 0;
  for (int x = 0; x < row.radius + kGuidedSlack; ++x) padded[row.radius + row.width + x] = 0;
  for (int x = 0; x < row.width; x += kLanes) {
    Vec sum = load(padded + x);
    for (int i = 1; i <= 2 * row.radius; ++i) sum += load(padded + x + i);
    store(out + x, sum);
  }
}

void sum_products(const GuideRow& row, const float* values, float* scratch, float* const* out) {
  float* payload = scratch + row.radius;
  __builtin_memcpy(payload, values, sizeof(float) * row.width);
  sum_along(row, scratch, out[0]);
  for (int c = 0; c < row.channels; ++c) {
    for (int x = 0; x < row.width; x += kLanes) {
      store(payload + x, load(values + x) * load(row.guide[c] + x));
    }
    sum_along(row, scratch, out[c + 1]);
  }
}

inline Vec sum_down(const GuidedSums& sums, int plane, int x) {
  Vec sum = load(sums.planes[0][plane] + x);
  for (int i = 1; i < sums.rows; ++i) sum += load(sums.planes[i][plane] + x);
  return sum;
}

template <int kChannels>
inline void solve_at(const GuideRow& row, const GuidedSums& sums, float share, int x,
                     float* const* models) {
  const Vec scale = load(row.share + x) * share;
  const Vec mean = sum_down(sums, 0, x) * scale;
  Vec covariance[kChannels];
  for (int c = 0; c < kChannels; ++c) {
    covariance[c] = sum_down(sums, c + 1, x) * scale - load(row.mean[c] + x) * mean;
  }
  const auto inverse = [&](int i) { return load(row.inverse[i] + x); };
  Vec a[kChannels];
  if constexpr (kChannels == 1) {
    a[0] = inverse(0) * covariance[0];
  } else {
    const Vec i01 = inverse(1);
    const Vec i02 = inverse(2);
    const Vec i12 = inverse(4);
    a[0] = inverse(0) * covariance[0] + i01 * covariance[1] + i02 * covariance[2];
    a[1] = i01 * covariance[0] + inverse(3) * covariance[1] + i12 * covariance[2];
    a[2] = i02 * covariance[0] + i12 * covariance[1] + inverse(5) * covariance[2];
  }
  Vec b = mean;
  for (int c = 0; c < kChannels; ++c) {
    b -= a[c] * load(row.mean[c] + x);
    store(models[c + 1] + x, a[c]);
  }
  store(models[0] + x, b);
}

void solve(const GuideRow& row, const GuidedSums& sums, float* scratch, float* const* models,
           float* const* out) {
  const float share = 1.0F / static_cast<float>(sums.rows);
  for (int x = 0; x < row.width; x += kLanes) {
    if (row.channels == 3) {
      solve_at<3>(row, sums, share, x, models);
    } else {
      solve_at<1>(row, sums, share, x, models);
    }
  }
  for (int plane = 0; plane <= row.channels; ++plane) {
    __builtin_memcpy(scratch + row.radius, models[plane], sizeof(float) * row.width);
    sum_along(row, scratch, out[plane]);
  }
}

void apply(const GuideRow& row, const GuidedSums& sums, float* out) {
  const float share = 1.0F / static_cast<float>(sums.rows);
  int x = 0;
  const auto filtered = [&] {
    Vec sum = sum_down(sums, 0, x);
    for (int c = 0; c < row.channels; ++c) {
      sum += sum_down(sums, c + 1, x) * load(row.guide[c] + x);
    }
    return sum * load(row.share + x) * share;
  };
  for (; x + kLanes <= row.width; x += kLanes) store(out + x, filtered());
  if (x == row.width) return;
  // What follows the row belongs to other data.
  const Vec rest = filtered();
  __builtin_memcpy(out + x, &rest, sizeof(float) * (row.width - x));
}

}  // namespace

extern const GuidedKernel kGuidedKernel;
const GuidedKernel kGuidedKernel{sum_products, solve, apply};

}  // namespace episcope::EPISCOPE_KERNEL_NAMESPACE
