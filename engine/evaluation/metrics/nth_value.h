// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace episcope {

/// The value with this rank, from 0, among values ≥ 0 that `feed(sink)` gives to a sink one by one,
/// twice and alike. Counts in half a megabyte instead of sorting: floats ≥ 0 are ordered as their
/// bits are. Precondition: there are more than `rank` values.
template <class Feed>
[[nodiscard]] float nth_value(Feed feed, std::size_t rank) {
  constexpr int half = 16;
  constexpr std::uint32_t low_mask = (1U << half) - 1;
  std::vector<std::size_t> counts(1U << half);
  const auto take_bin = [&] {
    std::uint32_t bin = 0;
    while (rank >= counts[bin]) rank -= counts[bin++];
    return bin;
  };
  feed([&](float value) { ++counts[std::bit_cast<std::uint32_t>(value) >> half]; });
  const std::uint32_t high = take_bin();
  counts.assign(counts.size(), 0);
  feed([&](float value) {
    const auto bits = std::bit_cast<std::uint32_t>(value);
    if (bits >> half == high) ++counts[bits & low_mask];
  });
  return std::bit_cast<float>(high << half | take_bin());
}

}  // namespace episcope
