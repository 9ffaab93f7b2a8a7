// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// Exponentials and logarithms of registers. For kernel sources only, as simd.h.

#include "engine/core/parallel/simd.h"

namespace episcope::EPISCOPE_KERNEL_NAMESPACE {
namespace {

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

}  // namespace
}  // namespace episcope::EPISCOPE_KERNEL_NAMESPACE
