// SPDX-License-Identifier: BSD-3-Clause
// Compiled once for each instruction set: see engine/core/parallel/isa.h for what may stand here.
#include "engine/labeling/features/surface_filter_kernel.h"

#include "engine/core/parallel/simd_math.h"

namespace episcope::EPISCOPE_KERNEL_NAMESPACE {
namespace {

inline Vec magnitude(Vec value) {
  return reinterpret_cast<Vec>(reinterpret_cast<IntVec>(value) & 0x7FFFFFFF);
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
