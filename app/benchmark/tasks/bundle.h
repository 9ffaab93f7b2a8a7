// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

namespace episcope {

/// Cuts a sequence of runs into bundles of neighbours, each as short as possible with at least
/// `least_seconds` of work (the last may be shorter); returns the first run of each bundle. A
/// bundle is never longer than `least_seconds` plus its last run. Linear.
[[nodiscard]] std::vector<std::size_t> bundle_starts(const std::vector<double>& seconds,
                                                     double least_seconds);

}  // namespace episcope
