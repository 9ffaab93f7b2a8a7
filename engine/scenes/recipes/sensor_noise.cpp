// SPDX-License-Identifier: BSD-3-Clause
#include "engine/scenes/recipes/sensor_noise.h"

#include "engine/scenes/recipes/mix.h"

namespace episcope::scenes {

float sensor_noise(unsigned seed, std::uint64_t counter) {
  const std::uint64_t stream = mix(seed * kGolden + 1);
  std::uint32_t sum = 0;
  for (std::uint64_t i = 0; i < 3; ++i) {
    const std::uint64_t bits = mix(stream + (3 * counter + i) * kGolden);
    for (int k = 0; k < 4; ++k) sum += static_cast<std::uint32_t>(bits >> (16 * k) & 0xFFFF);
  }
  // The mean of a 16-bit number is 0x7FFF.8.
  return (static_cast<float>(sum) - 12 * 32767.5F) / 65536.0F;
}

}  // namespace episcope::scenes
