// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace episcope::cuda {

/// A stored sample in [0, 1], as DeviceSamples::at, where its type is known.
__device__ inline float to_unit(std::uint8_t stored) {
  return (1.0F / 255) * static_cast<float>(stored);
}
__device__ inline float to_unit(std::uint16_t stored) {
  return (1.0F / 65535) * static_cast<float>(stored);
}
__device__ inline float to_unit(float stored) {
  return stored;
}

/// √, to the last bit but one.
__device__ inline float quick_root(float value) {
  float root;
  asm("sqrt.approx.f32 %0, %1;" : "=f"(root) : "f"(value));
  return root;
}

}  // namespace episcope::cuda
