// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <concepts>
#include <cstddef>
#include <limits>
#include <optional>
#include <span>
#include <type_traits>
#include <vector>

namespace episcope {

/// The quantile `share` of the values by nearest rank: in ascending order, the element of index
/// `share`·(n − 1), halves rounded up. 0.5 gives the median, of an even count the upper of the two
/// middle values. `share` is clamped to [0, 1]. Reorders the values, in linear time.
/// Precondition: not empty, no NaN.
[[nodiscard]] float quantile(std::span<float> values, double share);
[[nodiscard]] double quantile(std::span<double> values, double share);

/// Index of that quantile among `count` ≥ 1 values in ascending order.
[[nodiscard]] std::ptrdiff_t quantile_rank(std::size_t count, double share);

/// The quantile 0.5 of the values; 0 if there are none.
[[nodiscard]] double median(std::vector<double> values);

/// `number` as an int, if it is whole and fits one; nothing otherwise, also for NaN. For numbers
/// out of files: the cast of others is undefined.
[[nodiscard]] inline std::optional<int> whole_int(double number) {
  const bool fits = number >= std::numeric_limits<int>::min() &&
                    number <= std::numeric_limits<int>::max() && number == std::trunc(number);
  return fits ? std::optional(static_cast<int>(number)) : std::nullopt;
}

/// The smallest multiple of `unit` that is not below `value` ≥ 0.
template <std::integral T>
[[nodiscard]] constexpr T round_up(T value, std::type_identity_t<T> unit) {
  return (value + unit - 1) / unit * unit;
}

}  // namespace episcope
