// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace episcope::scenes {

/// The step of SplitMix64 and its finaliser, which turns counters into random bits (Steele, Lea,
/// Flood 2014): the same on every machine.
inline constexpr std::uint64_t kGolden = 0x9E3779B97F4A7C15ULL;

[[nodiscard]] constexpr std::uint64_t mix(std::uint64_t z) {
  z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9ULL;
  z = (z ^ (z >> 27)) * 0x94D049BB133111EBULL;
  return z ^ (z >> 31);
}

}  // namespace episcope::scenes
