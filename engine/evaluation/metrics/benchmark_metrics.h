// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/evaluation/metrics/region_metrics.h"

#include <string>
#include <vector>

namespace episcope {

/// What ends the keys of numbers that the official tool computes in high resolution, where they are
/// those of the low one.
inline constexpr const char* kLowResSuffix = "_lowres";

/// Numbers of benchmark2016 from errors alone.
struct BenchmarkMetrics {
  Metrics general;                 ///< Of all pixels: ResolvedErrors::general.
  Metrics masked;                  ///< Of regions: masked_metrics.
  std::vector<std::string> notes;  ///< Sentences: which numbers are missing, and why.
};

/// The scene of the benchmark that rules and masks are those of: as `options` say, else as the
/// names of the masks tell.
[[nodiscard]] StratifiedScene scene_of(const RegionInput& input);

/// Official keys for what is computed as the official tool does: in high resolution for masked
/// metrics and everything of backgammon, dots and stripes, in that of the views for the general
/// ones of other scenes. The same of the low resolution end in `kLowResSuffix`. High resolution is
/// read here, one map and one mask or two at a time, and released; what cannot be read is noted.
/// Throws InvalidInput, Cancelled.
[[nodiscard]] BenchmarkMetrics benchmark_metrics(const RegionInput& input);

}  // namespace episcope
