// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/evaluation/metrics/metrics.h"

#include <cstddef>
#include <vector>

namespace episcope {

/// What a part of a view scored.
struct PartScore {
  std::size_t pixels = 0;  ///< That were judged.
  Metrics metrics;         ///< Empty without such pixels.
};

/// Scores the judged pixels of an evaluation where `part` is not 0; it has the size of the view,
/// null = everywhere. The metrics are those of `evaluate` that follow from the errors alone: of
/// vmv2013 mse_100 and density, of benchmark2016 also badpix_0010, badpix_0030, badpix_0070 and
/// q_25_100. Missing estimates count as InvalidEstimates::Bad does; for MSE, the farthest true
/// disparity is that of the whole view, as in the map of errors.
[[nodiscard]] PartScore score_part(const Evaluation& evaluation, const Image<std::uint8_t>* part,
                                   Protocol protocol);

/// The errors of the pixels whose true disparity lies in one of the bins of an axis.
struct ErrorBin {
  Interval disparity;      ///< True disparities, px.
  std::size_t pixels = 0;  ///< Judged ones, > 0.
  double mse_100 = 0;      ///< 100 · mean of the squared errors, px².
  double bad_percent = 0;  ///< With |error| strictly above the threshold, or missing.
};

/// Errors by true disparity: `bins` > 0 equal parts of the range of the true disparities that were
/// judged in `part` (null = everywhere), without those that no pixel lies in. `truth` is the map
/// that the evaluation is of.
[[nodiscard]] std::vector<ErrorBin> errors_by_disparity(const Evaluation& evaluation,
                                                        const DisparityView& truth,
                                                        const Image<std::uint8_t>* part, int bins,
                                                        double bad_threshold_px);

}  // namespace episcope
