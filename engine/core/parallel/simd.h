// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// Vectors of floats as wide as the instruction set that a kernel source is compiled for
/// (engine/core/parallel/isa.h), by the compiler's vector extensions. For kernel sources only:
/// everything here has internal linkage, in the namespace of that instruction set.

#if defined(__x86_64__)
#include <immintrin.h>
#endif

#ifndef EPISCOPE_VECTOR_BYTES
#define EPISCOPE_VECTOR_BYTES 16
#define EPISCOPE_KERNEL_NAMESPACE baseline
#endif

namespace episcope::EPISCOPE_KERNEL_NAMESPACE {
namespace {

constexpr int kLanes = EPISCOPE_VECTOR_BYTES / sizeof(float);
typedef float Vec __attribute__((vector_size(EPISCOPE_VECTOR_BYTES)));
typedef int IntVec __attribute__((vector_size(EPISCOPE_VECTOR_BYTES)));
typedef float LooseVec __attribute__((vector_size(EPISCOPE_VECTOR_BYTES), aligned(4), may_alias));

[[maybe_unused]] inline Vec load(const float* from) {
  return *reinterpret_cast<const LooseVec*>(from);
}
[[maybe_unused]] inline void store(float* to, Vec value) {
  *reinterpret_cast<LooseVec*>(to) = value;
}
[[maybe_unused]] inline Vec splat(float value) {
  return value - Vec{};
}
[[maybe_unused]] inline Vec choose(IntVec mask, Vec yes, Vec no) {
  return mask ? yes : no;
}
[[maybe_unused]] inline Vec least(Vec a, Vec b) {
  return a < b ? a : b;
}
[[maybe_unused]] inline Vec greatest(Vec a, Vec b) {
  return a > b ? a : b;
}
[[maybe_unused]] inline Vec absolute(Vec value) {
  return choose(value < 0.0F, -value, value);
}
[[maybe_unused]] inline Vec square_root(Vec value) {
  Vec root;
  for (int i = 0; i < kLanes; ++i) root[i] = __builtin_sqrtf(value[i]);
  return root;
}

/// Whether any lane of a comparison holds.
[[maybe_unused]] inline bool any(IntVec mask) {
#if defined(__AVX512F__) && EPISCOPE_VECTOR_BYTES == 64
  const auto lanes = reinterpret_cast<__m512i>(mask);
  return _mm512_test_epi32_mask(lanes, lanes) != 0;
#elif defined(__AVX2__) && EPISCOPE_VECTOR_BYTES == 32
  return _mm256_movemask_ps(reinterpret_cast<__m256>(mask)) != 0;
#elif defined(__SSE2__) && EPISCOPE_VECTOR_BYTES == 16
  return _mm_movemask_ps(reinterpret_cast<__m128>(mask)) != 0;
#else
  for (int i = 0; i < kLanes; ++i) {
    if (mask[i] != 0) return true;
  }
  return false;
#endif
}

/// 1/value to about 22 bits, value > 0: a quarter of the time of a division.
[[maybe_unused]] inline Vec reciprocal(Vec value) {
#if defined(__AVX512F__) && EPISCOPE_VECTOR_BYTES == 64
  const Vec guess =
      reinterpret_cast<Vec>(_mm512_maskz_rcp14_ps(0xFFFF, reinterpret_cast<__m512>(value)));
#elif defined(__AVX2__) && EPISCOPE_VECTOR_BYTES == 32
  const Vec guess = reinterpret_cast<Vec>(_mm256_rcp_ps(reinterpret_cast<__m256>(value)));
#elif defined(__SSE2__) && EPISCOPE_VECTOR_BYTES == 16
  const Vec guess = reinterpret_cast<Vec>(_mm_rcp_ps(reinterpret_cast<__m128>(value)));
#else
  const Vec guess = 1.0F / value;
#endif
  return guess * (2.0F - value * guess);  // one Newton step
}

}  // namespace
}  // namespace episcope::EPISCOPE_KERNEL_NAMESPACE
