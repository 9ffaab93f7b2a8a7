// SPDX-License-Identifier: BSD-3-Clause
#include "engine/scenes/recipes/sensor_noise.h"

namespace episcope::scenes {
namespace {

// The finaliser of SplitMix64 (Steele, Lea, Flood 2014).
std::uint64_t mix(std::uint64_t z) {
  z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9ULL;
  z = (z ^ (z >> 27)) * 0x94D049BB133111EBULL;
  return z ^ (z >> 31);
}

}  // namespace

float sensor_noise(unsigned seed, std::uint64_t counter) {
  constexpr std::uint64_t golden = 0x9E3779B97F4A7C15ULL;
  const std::uint64_t stream = mix(seed * golden + 1);
  std::uint32_t sum = 0;
  for (std::uint64_t i = 0; i < 3; ++i) {
    const std::uint64_t bits = mix(stream + (3 * counter + i) * golden);
    for (int k = 0; k < 4; ++k) sum += static_cast<std::uint32_t>(bits >> (16 * k) & 0xFFFF);
  }
  // The mean of a 16-bit number is 0x7FFF.8.
  return (static_cast<float>(sum) - 12 * 32767.5F) / 65536.0F;
}

}  // namespace episcope::scenes
