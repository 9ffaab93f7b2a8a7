// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <limits>
#include <optional>

namespace episcope {

/// `number` as an int, if it is whole and fits one; nothing otherwise, also for NaN. For numbers
/// out of files: the cast of others is undefined.
[[nodiscard]] inline std::optional<int> whole_int(double number) {
  const bool fits = number >= std::numeric_limits<int>::min() &&
                    number <= std::numeric_limits<int>::max() && number == std::trunc(number);
  return fits ? std::optional(static_cast<int>(number)) : std::nullopt;
}

}  // namespace episcope
