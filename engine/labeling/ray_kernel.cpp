// SPDX-License-Identifier: BSD-3-Clause
#include "engine/labeling/ray_kernel.h"

#include "engine/core/simd.h"

// Compiled once for each instruction set: see engine/core/isa.h for what may stand here.

namespace episcope::EPISCOPE_KERNEL_NAMESPACE {
namespace {

inline IntVec splat_int(int value) {
  return value - IntVec{};
}

inline IntVec load_int(const std::int32_t* from) {
  return reinterpret_cast<IntVec>(load(reinterpret_cast<const float*>(from)));
}

inline void store_int(std::int32_t* to, IntVec value) {
  store(reinterpret_cast<float*>(to), reinterpret_cast<Vec>(value));
}

// At an end that is no multiple of the lanes away they overlap those before.
inline int begin_of(int x, int end) {
  return x + kLanes <= end ? x : end - kLanes;
}

inline IntVec are_valid(const std::uint8_t* valid, IntVec index) {
  IntVec found;
  for (int i = 0; i < kLanes; ++i) found[i] = valid[index[i]] != 0 ? -1 : 0;
  return found;
}

void find_targets(const RayRow& rays, std::int32_t* targets) {
  const Vec end_x = splat(static_cast<float>(rays.width));
  const Vec end_y = splat(static_cast<float>(rays.height));
  IntVec lanes;
  for (int i = 0; i < kLanes; ++i) lanes[i] = i;
  for (int next = rays.begin; next < rays.end; next += kLanes) {
    const int x = begin_of(next, rays.end);
    const Vec d = load(rays.disparity + x);
    const Vec at_x = convert<float>(lanes + x) - d * rays.step_x + 0.5F;
    const Vec at_y = rays.row - d * rays.step_y + 0.5F;
    // Of what is too far off to be an int, or no number, the comparisons do not hold.
    IntVec arrives = (at_x >= 0.0F) & (at_x < end_x) & (at_y >= 0.0F) & (at_y < end_y);
    const IntVec to_x = convert<int>(choose(arrives, at_x, splat(0)));
    const IntVec to_y = convert<int>(choose(arrives, at_y, splat(0)));
    const IntVec target = to_y * rays.width + to_x;
    // Values that are not numbers are not within any tolerance.
    arrives &= absolute(gathered(rays.there, target) - d) <= rays.tolerance;
    if (rays.valid != nullptr) arrives &= are_valid(rays.valid, lanes + x);
    if (rays.valid_there != nullptr) arrives &= are_valid(rays.valid_there, target);
    store_int(targets + x, arrives ? target : splat_int(-1));
  }
}

inline float trust_of(const RayTrusts& rays, int x) {
  const std::int32_t target = rays.targets[x];
  if (target < 0) return 0;
  int sum = 0;
  for (long c = 0; c < 3; ++c) {
    const int difference = rays.row[3L * x + c] - rays.other[3L * target + c];
    sum += difference * difference;
  }
  return rays.table[sum < rays.most ? sum : rays.most];
}

// Three channels of pixels, and the first of the next one, in the bytes of each lane.
inline IntVec colors_at(const std::uint8_t* colors, IntVec pixels) {
#if defined(__AVX2__) && EPISCOPE_VECTOR_BYTES == 32
  return reinterpret_cast<IntVec>(_mm256_i32gather_epi32(reinterpret_cast<const int*>(colors),
                                                         reinterpret_cast<__m256i>(pixels * 3), 1));
#elif defined(__AVX512F__) && EPISCOPE_VECTOR_BYTES == 64
  return reinterpret_cast<IntVec>(_mm512_mask_i32gather_epi32(
      _mm512_setzero_si512(), 0xFFFF, reinterpret_cast<__m512i>(pixels * 3), colors, 1));
#else
  IntVec found;
  for (int i = 0; i < kLanes; ++i) {
    int bytes;
    __builtin_memcpy(&bytes, colors + 3L * pixels[i], sizeof bytes);
    found[i] = bytes;
  }
  return found;
#endif
}

inline IntVec squared_difference(IntVec a, IntVec b, int shift) {
  const IntVec difference = (a >> shift & 255) - (b >> shift & 255);
  return difference * difference;
}

void find_trusts(const RayTrusts& rays, float* trusts) {
  IntVec lanes;
  for (int i = 0; i < kLanes; ++i) lanes[i] = i;
  int x = rays.begin;
  // The byte behind the last pixel of all is not there.
  for (; x + kLanes <= rays.end && x + kLanes < rays.width; x += kLanes) {
    const IntVec target = load_int(rays.targets + x);
    const IntVec arrives = target >= 0;
    if (any(target == rays.last)) {
      for (int i = 0; i < kLanes; ++i) trusts[x + i] = trust_of(rays, x + i);
      continue;
    }
    const IntVec here = colors_at(rays.row, lanes + x);
    const IntVec there = colors_at(rays.other, target & arrives);
    const IntVec sum = squared_difference(here, there, 0) + squared_difference(here, there, 8) +
                       squared_difference(here, there, 16);
    const Vec trust = gathered(rays.table, sum < rays.most ? sum : splat_int(rays.most));
    store(trusts + x, choose(arrives, trust, splat(0)));
  }
  for (; x < rays.end; ++x) trusts[x] = trust_of(rays, x);
}

inline long offset_of(const RayCosts& rays, std::int32_t target) {
  return static_cast<long>(target / rays.width) * rays.labels * rays.width + target % rays.width;
}

void add_costs_of_ray(const RayCosts& rays, int x, float* costs) {
  const std::uint8_t* code = rays.codes + offset_of(rays, rays.targets[x]);
  float* cost = costs + x;
  for (int l = 0; l < rays.labels; ++l, code += rays.width, cost += rays.width) {
    *cost += rays.trusts[x] * rays.table[*code];
  }
}

// Neighbors that arrive side by side, as nearly all do. What does not count may be anything that
// can be read.
inline bool are_side_by_side(const RayCosts& rays, int x, int first, long offset) {
  const IntVec counts = load(rays.trusts + x) > 0.0F;
  IntVec lanes;
  for (int i = 0; i < kLanes; ++i) lanes[i] = i - first;
  const IntVec others = load_int(rays.targets + x) != lanes + rays.targets[x + first];
  const long begin = offset - first;
  const long last = begin + static_cast<long>(rays.labels - 1) * rays.width + kLanes;
  return !any(counts & others) && begin >= 0 && last <= rays.size;
}

typedef std::uint8_t Codes __attribute__((vector_size(kLanes), aligned(1), may_alias));

inline bool is_zero(Codes codes) {
  unsigned long long words[2] = {};
  __builtin_memcpy(words, &codes, sizeof codes);
  return (words[0] | words[1]) == 0;
}

void add_costs_side_by_side(const RayCosts& rays, int x, long offset, float* costs) {
  const std::uint8_t* code = rays.codes + offset;
  float* cost = costs + x;
  const Vec trust = load(rays.trusts + x);
  for (int l = 0; l < rays.labels; ++l, code += rays.width, cost += rays.width) {
    const Codes codes = *reinterpret_cast<const Codes*>(code);
    // Most labels are out of the question for all of them.
    const Vec of_code = is_zero(codes)
                            ? splat(rays.table[0])
                            : gathered(rays.table, __builtin_convertvector(codes, IntVec));
    store(cost, load(cost) + trust * of_code);
  }
}

void add_costs(const RayCosts& rays, float* costs) {
  const int whole = rays.width / kLanes * kLanes;
  for (int x = 0; x < whole; x += kLanes) {
    unsigned counting = lanes_of(load(rays.trusts + x) > 0.0F);
    if (counting == 0) continue;
    const int first = __builtin_ctz(counting);
    const long offset = offset_of(rays, rays.targets[x + first]);
    if (are_side_by_side(rays, x, first, offset)) {
      add_costs_side_by_side(rays, x, offset - first, costs);
      continue;
    }
    for (; counting != 0; counting &= counting - 1) {
      add_costs_of_ray(rays, x + __builtin_ctz(counting), costs);
    }
  }
  for (int x = whole; x < rays.width; ++x) {
    if (rays.trusts[x] > 0) add_costs_of_ray(rays, x, costs);
  }
}

}  // namespace

const RayKernel kRayKernel = {find_targets, find_trusts, add_costs};

}  // namespace episcope::EPISCOPE_KERNEL_NAMESPACE
