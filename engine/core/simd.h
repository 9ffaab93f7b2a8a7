// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// Registers of numbers, as wide as the instruction set that a kernel source is compiled for
/// (engine/core/isa.h), by the compiler's vector extensions: the operators of numbers work
/// lane by lane, also with a single number on one side, and [] is one lane. A comparison gives a
/// mask: integers of the same size, −1 in the lanes where it holds, else 0. `Pack` has the same
/// operations on a number of lanes that does not depend on the instruction set.
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

/// Lanes of two vectors by their numbers; the lanes of `b` follow the lanes of `a`.
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

// Exponentials and logarithms of registers.

/// 2^x, x ≤ 0, to 2·10⁻⁷; what is below 2⁻¹²⁰ becomes that. Taylor's series about the nearest whole
/// number, which adding 1.5·2²³ leaves in the lowest bits.
[[maybe_unused]] inline Vec power_of_two(Vec x) {
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

/// log x of normal x > 0, to 2·10⁻⁷ and 2·10⁻⁷ of its size: x = m·2^e with m from √½ to √2, and
/// log m = 2 artanh t, t = (m − 1)/(m + 1).
[[maybe_unused]] inline Vec natural_log(Vec x) {
  constexpr int kRootOfHalf = 0x3f3504f3;
  const IntVec above = reinterpret_cast<IntVec>(x) - kRootOfHalf;
  const IntVec exponent = above >> 23;
  const Vec m = reinterpret_cast<Vec>((above & 0x7fffff) + kRootOfHalf);
  const Vec t = (m - 1.0F) / (m + 1.0F);
  const Vec square = t * t;
  Vec series = square * 0.22222222F + 0.28571429F;
  series = series * square + 0.4F;
  series = series * square + 0.66666667F;
  series = series * square + 2.0F;
  return t * series + convert<float>(exponent) * 0.69314718F;
}

// Packs: 64 bytes of numbers whatever the instruction set, as many registers as that takes, worked
// on together by the operations above. Each is exact IEEE arithmetic on every lane, so a source
// compiled without fused multiply-add (-ffp-contract=off) gives the same bits on all instruction
// sets.

constexpr int kPackBytes = 64;
constexpr int kParts = kPackBytes / EPISCOPE_VECTOR_BYTES;

template <int bytes>
struct IntegerOf;
template <>
struct IntegerOf<4> {
  using Type = __INT32_TYPE__;
};
template <>
struct IntegerOf<8> {
  using Type = __INT64_TYPE__;
};

template <class T>
struct Pack;

/// Applies `operation` to the registers of the packs, part by part.
template <class Result, class Operation, class... Packs>
inline Result by_parts(const Operation& operation, const Packs&... packs) {
  Result result;
  for (int i = 0; i < kParts; ++i) result.part[i] = operation(packs.part[i]...);
  return result;
}

#define EPISCOPE_PACK_OPERATOR(Result, op)                                \
  friend Result operator op(const Pack& a, const Pack& b) {               \
    return by_parts<Result>([](auto x, auto y) { return x op y; }, a, b); \
  }

template <class T>
struct Pack {
  static constexpr int kLanes = kPackBytes / static_cast<int>(sizeof(T));
  static constexpr int kPartLanes = kLanes / kParts;
  using Mask = Pack<typename IntegerOf<sizeof(T)>::Type>;

  Register<T> part[kParts];

  Pack() = default;
  /// The same number in every lane.
  Pack(T value) {
    for (auto& p : part) p = value - Register<T>{};
  }
  T operator[](int lane) const { return part[lane / kPartLanes][lane % kPartLanes]; }
  T& operator[](int lane) {
#ifdef __clang__  // knows no reference to a lane; its vectors alias their lanes
    return reinterpret_cast<T*>(part)[lane];
#else
    return part[lane / kPartLanes][lane % kPartLanes];
#endif
  }

  EPISCOPE_PACK_OPERATOR(Pack, +)
  EPISCOPE_PACK_OPERATOR(Pack, -)
  EPISCOPE_PACK_OPERATOR(Pack, *)
  EPISCOPE_PACK_OPERATOR(Pack, /)
  EPISCOPE_PACK_OPERATOR(Pack, &)
  EPISCOPE_PACK_OPERATOR(Pack, |)
  EPISCOPE_PACK_OPERATOR(Pack, ^)
  EPISCOPE_PACK_OPERATOR(Mask, ==)
  EPISCOPE_PACK_OPERATOR(Mask, <)
  EPISCOPE_PACK_OPERATOR(Mask, <=)
  EPISCOPE_PACK_OPERATOR(Mask, >)
  EPISCOPE_PACK_OPERATOR(Mask, >=)
  friend Pack operator-(const Pack& a) {
    return by_parts<Pack>([](auto x) { return -x; }, a);
  }
  friend Pack operator>>(const Pack& a, int bits) {
    return by_parts<Pack>([bits](auto x) { return x >> bits; }, a);
  }
};
#undef EPISCOPE_PACK_OPERATOR

using Floats = Pack<float>;
using Ints = Pack<int>;
using Uints = Pack<unsigned>;
using Doubles = Pack<double>;
template <class T>
using Mask = typename Pack<T>::Mask;

template <class T>
inline void store(T* to, const Pack<T>& value) {
  __builtin_memcpy(to, value.part, sizeof value.part);
}
template <class M, class T>
inline Pack<T> choose(const Pack<M>& mask, const Pack<T>& yes, const Pack<T>& no) {
  return by_parts<Pack<T>>([](auto m, auto y, auto n) { return m ? y : n; }, mask, yes, no);
}
template <class T>
inline Pack<T> least(const Pack<T>& a, const Pack<T>& b) {
  return by_parts<Pack<T>>([](auto x, auto y) { return least(x, y); }, a, b);
}
template <class T>
inline Pack<T> greatest(const Pack<T>& a, const Pack<T>& b) {
  return by_parts<Pack<T>>([](auto x, auto y) { return greatest(x, y); }, a, b);
}
template <class T>
inline Pack<T> absolute(const Pack<T>& a) {
  return by_parts<Pack<T>>([](auto x) { return absolute(x); }, a);
}
template <class T>
inline Pack<T> square_root(const Pack<T>& a) {
  return by_parts<Pack<T>>([](auto x) { return square_root(x); }, a);
}
template <class To, class From>
inline Pack<To> convert(const Pack<From>& a) {
  return by_parts<Pack<To>>([](auto x) { return convert<To>(x); }, a);
}
template <class T>
inline bool any(const Pack<T>& mask) {
  Register<T> all{};
  for (int i = 0; i < kParts; ++i) all |= mask.part[i];
  return any(reinterpret_cast<IntVec>(all));
}

}  // namespace
}  // namespace episcope::EPISCOPE_KERNEL_NAMESPACE
