// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/parallel/simd.h"

/// 64 bytes of numbers whatever the instruction set: as many registers as that takes, worked on
/// together by the operations of simd.h. Each is exact IEEE arithmetic on every lane, so a source
/// compiled without fused multiply-add (-ffp-contract=off) gives the same bits on all instruction
/// sets. For kernel sources only.

namespace episcope::EPISCOPE_KERNEL_NAMESPACE {
namespace {

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
