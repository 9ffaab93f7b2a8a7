// SPDX-License-Identifier: BSD-3-Clause
#include "app/session/labels/judge_labeling.h"

#include "engine/labeling/consistency.h"

namespace episcope {

LabelingScores judge_labeling(const ViewStack<std::int32_t>& labels, ViewIndex view,
                              const ViewStack<std::int32_t>& truth, const GroundTruth& ground_truth,
                              const DisparityField* disparity, const Progress& progress) {
  LabelingScores scores;
  if (!truth.empty() && truth.contains(view) && labels.contains(view)) {
    scores.view = judge_label_quality(labels.view(view), truth.view(view));
  }
  if (labels.grid().count() == 1) return scores;
  if (truth.grid() == labels.grid()) {
    scores.all_views = judge_label_quality(labels, truth, progress);
  }
  const bool knows_rays =
      ground_truth.has_disparity() && ground_truth.field.disparity.grid() == labels.grid();
  if (const DisparityField* rays = knows_rays ? &ground_truth.field : disparity) {
    scores.consistency = label_consistency(labels, *rays, progress).share();
  }
  return scores;
}

}  // namespace episcope
