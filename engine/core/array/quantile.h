// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <span>

namespace episcope {

/// The quantile `share` of the values by nearest rank: the element of index `share`·(n − 1), halves
/// rounded up, in ascending order. 0.5 gives the median, of an even number of values the upper of
/// the two middle ones. `share` is clamped to [0, 1]. Reorders the values, in linear time.
/// Precondition: not empty, no NaN.
[[nodiscard]] float quantile(std::span<float> values, double share);

/// The index that it has among so many values, at least one, in ascending order.
[[nodiscard]] std::ptrdiff_t quantile_rank(std::size_t count, double share);

}  // namespace episcope
