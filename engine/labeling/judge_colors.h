// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/parallel/progress.h"
#include "engine/labeling/label_probabilities.h"
#include "engine/labeling/rays/ray_labeling.h"

namespace episcope {

/// Weighs the probabilities of all views by how well the colour of each pixel fits what has its
/// label nearby (local_colors.h). What is nearby tells the view `reference`, whose labels are
/// smoothed once, by itself, for it; pixels of other views are looked for there by their disparity
/// and stay as they are where that is not known. Pixels with a label of more than 0.95 stay as
/// well.
///
/// `input` without probabilities: those are `probabilities`, of the same views, `reference` among
/// them. Throws Cancelled.
void judge_colors(const RayLabelingInput& input, ViewIndex reference,
                  const RayLabelingParameters& parameters, const Progress& progress,
                  LabelProbabilities& probabilities);

}  // namespace episcope
