// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// Registers of numbers, as wide as the instruction set that a kernel source is compiled for
/// (engine/core/parallel/isa.h), by the compiler's vector extensions: the operators of numbers work
/// lane by lane, also with a single number on one side, and [] is one lane. A comparison gives a
/// mask: integers of the same size, −1 in the lanes where it holds, else 0. simd_pack.h has the
/// same operations on a number of lanes that does not depend on the instruction set.
/// For kernel sources only: everything here has internal linkage, in the namespace of the
/// instruction set.

#if defined(__x86_64__)
#include <immintrin.h>
#endif

#ifndef EPISCOPE_VECTOR_BYTES
#define EPISCOPE_VECTOR_BYTES 16
#define EPISCOPE_KERNEL_NAMESPACE baseline
#endif

namespace episcope::EPISCOPE_KERNEL_NAMESPACE {
namespace {

template <class T>
struct RegisterOf {
  typedef T Type __attribute__((vector_size(EPISCOPE_VECTOR_BYTES)));
};
template <class T>
using Register = typename RegisterOf<T>::Type;

using Vec = Register<float>;
using IntVec = Register<int>;
constexpr int kLanes = EPISCOPE_VECTOR_BYTES / sizeof(float);
/// The lanes of as many whole registers as hold `count` numbers.
[[maybe_unused]] constexpr int whole_registers(int count) {
  return (count + kLanes - 1) / kLanes * kLanes;
}

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

/// Lanes of two vectors by their numbers; those of `b` follow those of `a`.
[[maybe_unused]] inline Vec shuffled(Vec a, Vec b, IntVec lanes) {
#ifdef __clang__
  Vec taken;
  for (int i = 0; i < kLanes; ++i) {
    taken[i] = lanes[i] < kLanes ? a[lanes[i]] : b[lanes[i] - kLanes];
  }
  return taken;
#else
  return __builtin_shuffle(a, b, lanes);
#endif
}

template <class V>
inline V least(V a, V b) {
  return a < b ? a : b;
}
template <class V>
inline V greatest(V a, V b) {
  return a > b ? a : b;
}
template <class V>
inline V absolute(V value) {
  return value < V{} ? -value : value;
}
[[maybe_unused]] inline Vec square_root(Vec value) {
  Vec root;
  for (int i = 0; i < kLanes; ++i) root[i] = __builtin_sqrtf(value[i]);
  return root;
}
[[maybe_unused]] inline Register<double> square_root(Register<double> value) {
  Register<double> root;
  for (int i = 0; i < kLanes / 2; ++i) root[i] = __builtin_sqrt(value[i]);
  return root;
}

/// Each lane as another type of number of the same size; fractions are cut off.
template <class To, class V>
inline Register<To> convert(V value) {
  return __builtin_convertvector(value, Register<To>);
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

/// A bit for each lane, the first the lowest, set where a comparison holds.
[[maybe_unused]] inline unsigned lanes_of(IntVec mask) {
#if defined(__AVX512F__) && EPISCOPE_VECTOR_BYTES == 64
  const auto lanes = reinterpret_cast<__m512i>(mask);
  return _mm512_test_epi32_mask(lanes, lanes);
#elif defined(__AVX2__) && EPISCOPE_VECTOR_BYTES == 32
  return static_cast<unsigned>(_mm256_movemask_ps(reinterpret_cast<__m256>(mask)));
#elif defined(__SSE2__) && EPISCOPE_VECTOR_BYTES == 16
  return static_cast<unsigned>(_mm_movemask_ps(reinterpret_cast<__m128>(mask)));
#else
  unsigned lanes = 0;
  for (int i = 0; i < kLanes; ++i) lanes |= (mask[i] != 0 ? 1U : 0U) << i;
  return lanes;
#endif
}

/// The numbers at these places.
[[maybe_unused]] inline Vec gathered(const float* from, IntVec places) {
#if defined(__AVX2__) && EPISCOPE_VECTOR_BYTES == 32
  return reinterpret_cast<Vec>(
      _mm256_i32gather_ps(from, reinterpret_cast<__m256i>(places), sizeof(float)));
#elif defined(__AVX512F__) && EPISCOPE_VECTOR_BYTES == 64
  return reinterpret_cast<Vec>(_mm512_mask_i32gather_ps(
      _mm512_setzero_ps(), 0xFFFF, reinterpret_cast<__m512i>(places), from, sizeof(float)));
#else
  Vec found;
  for (int i = 0; i < kLanes; ++i) found[i] = from[places[i]];
  return found;
#endif
}

/// 1/value to about 22 bits, value > 0; faster than a division.
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

/// 1/√value to about 23 bits, value > 0.
[[maybe_unused]] inline Vec reciprocal_root(Vec value) {
#if defined(__AVX512F__) && EPISCOPE_VECTOR_BYTES == 64
  const Vec guess =
      reinterpret_cast<Vec>(_mm512_maskz_rsqrt14_ps(0xFFFF, reinterpret_cast<__m512>(value)));
#elif defined(__AVX2__) && EPISCOPE_VECTOR_BYTES == 32
  const Vec guess = reinterpret_cast<Vec>(_mm256_rsqrt_ps(reinterpret_cast<__m256>(value)));
#elif defined(__SSE2__) && EPISCOPE_VECTOR_BYTES == 16
  const Vec guess = reinterpret_cast<Vec>(_mm_rsqrt_ps(reinterpret_cast<__m128>(value)));
#else
  const Vec guess = 1.0F / square_root(value);
#endif
  return guess * (1.5F - (0.5F * value) * (guess * guess));  // one Newton step
}

}  // namespace
}  // namespace episcope::EPISCOPE_KERNEL_NAMESPACE
