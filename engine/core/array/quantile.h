// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

namespace episcope {

/// The element that a share of the values lies below, by the nearest rank: that of index
/// `share`·(n − 1), halves rounded up, in ascending order; 0.5 gives the median, of an even count
/// the upper of the two in the middle. `share` outside [0, 1] is clamped. Reorders the values, in
/// linear time. Precondition: not empty, no NaN.
[[nodiscard]] float quantile(std::span<float> values, double share);

}  // namespace episcope
