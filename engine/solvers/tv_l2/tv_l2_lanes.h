// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// Vectors of pixels in the split rows of TvL2Level, and what both kernels of the solver do with
/// them. For kernel sources only (engine/core/parallel/isa.h).

#include "engine/core/parallel/simd.h"
#include "engine/solvers/tv_l2/tv_l2_kernel.h"

namespace episcope::EPISCOPE_KERNEL_NAMESPACE {
namespace {

/// Lanes of a half row, whole vectors.
[[maybe_unused]] inline int half_lanes(const TvL2Level& level) {
  return whole_registers((level.width + 1) / 2);
}
/// The same in whole pairs of vectors.
[[maybe_unused]] inline int half_pairs(const TvL2Level& level) {
  return ((level.width + 1) / 2 + 2 * kLanes - 1) / (2 * kLanes) * (2 * kLanes);
}

/// {0, 1 …} · stride + first.
[[maybe_unused]] inline IntVec ramp(int first, int stride) {
  IntVec lanes;
  for (int i = 0; i < kLanes; ++i) lanes[i] = first + i * stride;
  return lanes;
}

/// The last lane of `before`, then all but the last of `here`.
[[maybe_unused]] inline Vec shifted(Vec before, Vec here) {
  return shuffled(before, here, ramp(kLanes - 1, 1));
}

/// One value for each of a vector of even pixels and the odd ones to their right.
struct Halves {
  Vec even, odd;
};

[[maybe_unused]] inline Halves load_halves(const TvL2Level& level, const float* plane, long at) {
  return {load(plane + at), load(plane + at + level.odd)};
}
[[maybe_unused]] inline void store_halves(const TvL2Level& level, float* plane, long at,
                                          Halves values) {
  store(plane + at, values.even);
  store(plane + at + level.odd, values.odd);
}
/// The neighbours to the right.
[[maybe_unused]] inline Halves load_right(const TvL2Level& level, const float* plane, long at) {
  return {load(plane + at + level.odd), load(plane + at + 1)};
}
/// The neighbours to the left.
[[maybe_unused]] inline Halves load_left(const TvL2Level& level, const float* plane, long at) {
  return {load(plane + at + level.odd - 1), load(plane + at)};
}

/// Factor that projects z to |p| ≤ g.
[[maybe_unused]] inline Vec shrinkage(Vec zx, Vec zy, Vec g) {
  return least(splat(1), g * reciprocal_root(greatest(zx * zx + zy * zy, splat(1e-30F))));
}

[[maybe_unused]] inline void clear_row(float* row, long count) {
  for (long i = 0; i < count; ++i) row[i] = 0;
}

}  // namespace
}  // namespace episcope::EPISCOPE_KERNEL_NAMESPACE
