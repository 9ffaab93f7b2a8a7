// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// Arithmetic rounded as on the CPU, so that a choice between two nearly equal coherences falls the
/// same way: there, of a·b + c·d the second product is rounded and the first is not.

namespace episcope::cuda {

/// a·b + c·d
__device__ inline float two_products(float a, float b, float c, float d) {
  return __fmaf_rn(a, b, __fmul_rn(c, d));
}

/// 1/value but for the last bit or so: an approximation and one step by Newton.
__device__ inline float reciprocal(float value) {
  float guess;
  asm("rcp.approx.ftz.f32 %0, %1;" : "=f"(guess) : "f"(value));
  return guess * __fmaf_rn(-value, guess, 2.0F);
}

}  // namespace episcope::cuda
