// SPDX-License-Identifier: BSD-3-Clause
// Compiled once for each instruction set: see engine/core/parallel/isa.h for what may stand here.
#include "engine/labeling/features/surface_filter_kernel.h"

#include "engine/core/parallel/simd.h"

namespace episcope::EPISCOPE_KERNEL_NAMESPACE {
namespace {

inline Vec magnitude(Vec value) {
  return reinterpret_cast<Vec>(reinterpret_cast<IntVec>(value) & 0x7FFFFFFF);
}

// 2^x, x ≤ 0, to 2·10⁻⁷; what is below 2⁻¹²⁰ becomes that. Taylor's series about the nearest whole
// number, which adding 1.5·2²³ leaves in the lowest bits.
inline Vec power_of_two(Vec x) {
  constexpr float kRound = 12582912;
  x = greatest(x, splat(-120));
  const Vec shifted = x + kRound;
  const Vec f = x - (shifted - kRound);
  Vec p = f * 1.5403530e-4F + 1.3333558e-3F;
  p = p * f + 9.6181291e-3F;
  p = p * f + 5.5504109e-2F;
  p = p * f + 2.4022651e-1F;
  p = p * f + 6.9314718e-1F;
  p = p * f + 1.0F;
  const IntVec exponent = reinterpret_cast<IntVec>(shifted) << 23;
  return reinterpret_cast<Vec>(reinterpret_cast<IntVec>(p) + exponent);
}

void filter(const SurfaceTaps& taps, float* const* out) {
  for (int x = 0; x < taps.width; x += kLanes) {
    const float* const from[3] = {taps.channels[0] + x, taps.channels[1] + x, taps.channels[2] + x};
    const Vec own[3] = {load(from[0]), load(from[1]), load(from[2])};
    Vec sum[3] = {};
    Vec all{};
    for (int t = 0; t < taps.count; ++t) {
      const long at = taps.offsets[t];
      const Vec a = load(from[0] + at), b = load(from[1] + at), c = load(from[2] + at);
      const Vec difference = magnitude(a - own[0]) + magnitude(b - own[1]) + magnitude(c - own[2]);
      const Vec weight = power_of_two(taps.nearness[t] - taps.contrast * difference * difference);
      sum[0] += weight * a;
      sum[1] += weight * b;
      sum[2] += weight * c;
      all += weight;
    }
    for (int c = 0; c < 3; ++c) store(out[c] + x, sum[c] / all);
  }
}

}  // namespace

const SurfaceKernel kSurfaceKernel = {filter};

}  // namespace episcope::EPISCOPE_KERNEL_NAMESPACE
