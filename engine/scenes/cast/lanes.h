// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// For kernel sources only: 64 bytes of lanes whatever the instruction set. Every operation is exact
// IEEE arithmetic on each lane, so all instruction sets give the same bits.

namespace episcope::scenes::EPISCOPE_KERNEL_NAMESPACE {

constexpr int kPackBytes = 64;
constexpr int kParts = kPackBytes / EPISCOPE_VECTOR_BYTES;

template <class T>
struct Pack {
  typedef T Vector __attribute__((vector_size(EPISCOPE_VECTOR_BYTES)));
  static constexpr int kLanes = kPackBytes / static_cast<int>(sizeof(T));
  static constexpr int kPartLanes = EPISCOPE_VECTOR_BYTES / static_cast<int>(sizeof(T));
  Vector part[kParts];

  Pack() = default;
  Pack(T value) {
    for (auto& p : part) p = value - Vector{};
  }
  T operator[](int lane) const { return part[lane / kPartLanes][lane % kPartLanes]; }
  void set(int lane, T value) { part[lane / kPartLanes][lane % kPartLanes] = value; }
};

using Floats = Pack<float>;
using Ints = Pack<int>;
using Uints = Pack<unsigned>;
using Doubles = Pack<double>;
using Longs = Pack<long long>;

template <class T>
struct MaskOf;
template <>
struct MaskOf<float> {
  using Type = Ints;
};
template <>
struct MaskOf<double> {
  using Type = Longs;
};
template <class T>
using Mask = typename MaskOf<T>::Type;

#define EPISCOPE_LANES_OPERATOR(op)                                      \
  template <class T>                                                     \
  inline Pack<T> operator op(const Pack<T>& a, const Pack<T>& b) {       \
    Pack<T> r;                                                           \
    for (int i = 0; i < kParts; ++i) r.part[i] = a.part[i] op b.part[i]; \
    return r;                                                            \
  }                                                                      \
  template <class T>                                                     \
  inline Pack<T> operator op(const Pack<T>& a, T b) {                    \
    return a op Pack<T>(b);                                              \
  }                                                                      \
  template <class T>                                                     \
  inline Pack<T> operator op(T a, const Pack<T>& b) {                    \
    return Pack<T>(a) op b;                                              \
  }
EPISCOPE_LANES_OPERATOR(+)
EPISCOPE_LANES_OPERATOR(-)
EPISCOPE_LANES_OPERATOR(*)
EPISCOPE_LANES_OPERATOR(/)
EPISCOPE_LANES_OPERATOR(&)
EPISCOPE_LANES_OPERATOR(|)
EPISCOPE_LANES_OPERATOR(^)
#undef EPISCOPE_LANES_OPERATOR

#define EPISCOPE_LANES_COMPARISON(op)                                    \
  template <class T>                                                     \
  inline Mask<T> operator op(const Pack<T>& a, const Pack<T>& b) {       \
    Mask<T> r;                                                           \
    for (int i = 0; i < kParts; ++i) r.part[i] = a.part[i] op b.part[i]; \
    return r;                                                            \
  }                                                                      \
  template <class T>                                                     \
  inline Mask<T> operator op(const Pack<T>& a, T b) {                    \
    return a op Pack<T>(b);                                              \
  }
EPISCOPE_LANES_COMPARISON(<)
EPISCOPE_LANES_COMPARISON(<=)
EPISCOPE_LANES_COMPARISON(>)
EPISCOPE_LANES_COMPARISON(>=)
#undef EPISCOPE_LANES_COMPARISON

inline Ints equals(const Ints& a, int b) {
  Ints r;
  const Ints other(b);
  for (int i = 0; i < kParts; ++i) r.part[i] = a.part[i] == other.part[i];
  return r;
}

template <class T, class M>
inline Pack<T> select(const M& mask, const Pack<T>& a, const Pack<T>& b) {
  Pack<T> r;
  for (int i = 0; i < kParts; ++i) r.part[i] = mask.part[i] ? a.part[i] : b.part[i];
  return r;
}

template <class T>
inline Pack<T> minimum(const Pack<T>& a, const Pack<T>& b) {
  return select(a < b, a, b);
}
template <class T>
inline Pack<T> maximum(const Pack<T>& a, const Pack<T>& b) {
  return select(a > b, a, b);
}
template <class T>
inline Pack<T> clamp_unit(const Pack<T>& a) {
  return minimum(maximum(a, Pack<T>(T(0))), Pack<T>(T(1)));
}

template <class T>
inline bool any(const Pack<T>& mask) {
  typename Pack<T>::Vector all{};
  for (int i = 0; i < kParts; ++i) all |= mask.part[i];
  T folded = 0;
  for (int i = 0; i < Pack<T>::kPartLanes; ++i) folded |= all[i];
  return folded != 0;
}

inline Floats root(const Floats& a) {
  Floats r;
  for (int i = 0; i < kParts; ++i) {
    for (int k = 0; k < Floats::kPartLanes; ++k) r.part[i][k] = __builtin_sqrtf(a.part[i][k]);
  }
  return r;
}
inline Doubles root(const Doubles& a) {
  Doubles r;
  for (int i = 0; i < kParts; ++i) {
    for (int k = 0; k < Doubles::kPartLanes; ++k) r.part[i][k] = __builtin_sqrt(a.part[i][k]);
  }
  return r;
}

template <class To, class From>
inline Pack<To> convert(const Pack<From>& a) {
  Pack<To> r;
  for (int i = 0; i < kParts; ++i) {
    r.part[i] = __builtin_convertvector(a.part[i], typename Pack<To>::Vector);
  }
  return r;
}

/// Largest whole number not above `a`, of magnitude below 2^31.
inline Ints floor_to_int(const Floats& a) {
  const Ints cut = convert<int>(a);
  // A true comparison is −1.
  return cut + (convert<float>(cut) > a);
}

}  // namespace episcope::scenes::EPISCOPE_KERNEL_NAMESPACE
