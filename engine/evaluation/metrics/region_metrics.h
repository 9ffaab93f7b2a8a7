// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/evaluation/metrics/metrics.h"

#include <map>
#include <string>

namespace episcope {

/// What region metrics need besides the errors of an evaluation.
struct RegionInput {
  const DisparityView& estimate;
  const DisparityView& truth;
  const std::map<std::string, Image<std::uint8_t>>& regions;
  const EvaluationOptions& options;
};

/// Percentage of the judged pixels inside `region` (null = everywhere) with a signed error for
/// which `is_bad` holds. Missing pixels are bad or good as `invalid` says. Empty if no pixel is
/// inside.
template <class IsBad>
std::optional<double> bad_percentage(const Evaluation& evaluation,
                                     const Image<std::uint8_t>* region, InvalidEstimates invalid,
                                     IsBad is_bad) {
  std::size_t count = 0;
  std::size_t bad = 0;
  for (std::size_t i = 0; i < evaluation.judged.size(); ++i) {
    if (evaluation.judged.data()[i] == 0 || (region && region->data()[i] == 0)) continue;
    ++count;
    const bool counts_as_bad = evaluation.missing.data()[i] != 0
                                   ? invalid == InvalidEstimates::Bad
                                   : is_bad(evaluation.signed_error.data()[i]);
    if (counts_as_bad) ++bad;
  }
  if (count == 0) return std::nullopt;
  return 100.0 * static_cast<double>(bad) / static_cast<double>(count);
}

/// Appends the metrics of surfaces of benchmark2016, bumpiness and angles of normals, for the masks
/// there are. Regions with no judged pixel add nothing.
void append_region_metrics(Evaluation& evaluation, const RegionInput& input);

}  // namespace episcope
