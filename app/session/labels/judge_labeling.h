// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/light_field/scene.h"
#include "engine/core/parallel/progress.h"
#include "engine/evaluation/metrics/label_quality.h"

#include <optional>

namespace episcope {

/// How good labels are, as far as that can be told.
struct LabelingScores {
  LabelQuality view;       ///< Of one view; judges nothing without true labels of it.
  LabelQuality all_views;  ///< Of all, likewise.
  /// Share of rays that agree with the rays of the same scene point, in [0, 1]; none if one view
  /// alone is labeled or the rays are not known.
  std::optional<double> consistency;
};

/// Judges labels against `truth`, which may be empty or hold one view alone. Rays are followed
/// along the true disparity where all views have one, else along `disparity`, which may be null.
/// Throws InvalidInput if sizes differ, Cancelled.
[[nodiscard]] LabelingScores judge_labeling(const ViewStack<std::int32_t>& labels, ViewIndex view,
                                            const ViewStack<std::int32_t>& truth,
                                            const GroundTruth& ground_truth,
                                            const DisparityField* disparity,
                                            const Progress& progress);

}  // namespace episcope
