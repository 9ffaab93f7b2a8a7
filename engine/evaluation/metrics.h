// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/disparity_field.h"
#include "engine/core/ground_truth.h"

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace episcope {

/// Named protocols, never mixed (formats.md §6).
enum class Protocol {
  Vmv2013,       ///< All pixels with truth; mean squared error ×100 [WMG13].
  Benchmark2016  ///< A border of 15 px is ignored; BadPix, Q25, region metrics [HJKG16].
};

[[nodiscard]] const char* protocol_name(Protocol protocol);  ///< "vmv2013", "benchmark2016".
/// Throws InvalidInput naming both.
[[nodiscard]] Protocol parse_protocol(const std::string& name);

enum class InvalidEstimates {
  Bad,         ///< A missing value counts as a bad pixel, and for MSE as the farthest disparity.
  Compatible,  ///< As the official 2016 tool: a missing value counts as good in BadPix.
};

struct EvaluationOptions {
  Protocol protocol = Protocol::Vmv2013;
  InvalidEstimates invalid = InvalidEstimates::Bad;
};

/// Numbers by key ("mse_100", "badpix_0070", "density", …) in the order of tables. A metric that a
/// protocol or a scene lacks is absent, never 0.
using Metrics = std::vector<std::pair<std::string, double>>;

[[nodiscard]] std::optional<double> find_metric(const Metrics& metrics, const std::string& key);

/// Error of one view, and the numbers that were computed from it.
struct Evaluation {
  Metrics metrics;
  Image<float> signed_error;        ///< truth − estimate in px; 0 where not judged.
  Image<std::uint8_t> judged;       ///< 1 = pixel counts in the numbers.
  Image<std::uint8_t> missing;      ///< 1 = judged, but the estimate has no value there.
};

/// Judges one view of an estimate against one map of truth. `regions` may be empty.
/// Throws InvalidInput if the sizes differ or no pixel can be judged.
[[nodiscard]] Evaluation evaluate(const DisparityView& estimate, const DisparityView& truth,
                                  const std::map<std::string, Image<std::uint8_t>>& regions,
                                  const EvaluationOptions& options);

}  // namespace episcope
