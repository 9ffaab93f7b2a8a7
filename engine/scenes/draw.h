// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
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

/// Random draws that depend on the seed alone, on every machine. Draw one number per statement:
/// the order in which arguments are evaluated is not fixed.
class Draw {
 public:
  explicit Draw(std::uint64_t seed) : stream_(mix(seed * kGolden + 3)) {}

  /// Draws of their own, so that one more draw here changes nothing there.
  [[nodiscard]] Draw part(std::uint64_t number) const {
    return Draw(mix(stream_ + (number + 1) * 0xD1B54A32D192ED03ULL));
  }

  /// In [0, 1).
  double unit() {
    const std::uint64_t bits = mix(stream_ + ++count_ * kGolden);
    return static_cast<double>(bits >> 11) / 9007199254740992.0;  // 2^53
  }
  /// In [0, 1), small ones more often.
  double small() {
    const double u = unit();
    return u * u;
  }
  double between(double low, double high) { return low + (high - low) * unit(); }
  /// From `low` to `high`, both included.
  int integer(int low, int high) { return low + static_cast<int>(unit() * (high - low + 1)); }
  bool chance(double probability) { return unit() < probability; }
  /// −1 or 1.
  double sign() { return chance(0.5) ? 1 : -1; }
  std::uint32_t bits() { return static_cast<std::uint32_t>(mix(stream_ + ++count_ * kGolden)); }

  /// An index, in proportion to the weights.
  template <std::size_t n>
  int weighted(const std::array<double, n>& weights) {
    double total = 0;
    for (const double weight : weights) total += weight;
    double left = unit() * total;
    for (std::size_t i = 0; i < n; ++i) {
      left -= weights[i];
      if (left < 0) return static_cast<int>(i);
    }
    return 0;
  }

 private:
  std::uint64_t stream_;
  std::uint64_t count_ = 0;
};

}  // namespace episcope::scenes
