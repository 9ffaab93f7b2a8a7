// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/array/volume.h"
#include "engine/core/light_field/disparity_field.h"
#include "engine/core/light_field/scene.h"
#include "engine/core/parallel/progress.h"
#include "engine/labeling/forest/pixel_votes.h"
#include "engine/labeling/label_probabilities.h"

#include <cstdint>
#include <vector>

namespace episcope {

/// Strokes, and what is known about where their labels go on; borrowed.
struct StrokeKnowledge {
  const Scribbles& scribbles;
  const std::vector<std::int32_t>& ids;          ///< Of the labels painted, ascending.
  double nearness = 0;                           ///< LabelerParameters::nearness.
  const DisparityField* disparity = nullptr;     ///< Null = strokes stay in their views.
  const ViewStack<float>* confidence = nullptr;  ///< Of the disparity; null = it is right.
  bool judges_disparity = false;  ///< Whether disparity speaks for labels; it needs one then.
};

/// The votes of the forest for the pixels of a view, weighted by how well their disparity fits the
/// surfaces of the labels and by how near the strokes of each label are (labeler.h says why).
/// `features` of the view. Throws Cancelled.
[[nodiscard]] ProbabilityMap predict_from_strokes(const StrokeKnowledge& known, ViewIndex view,
                                                  VolumeView<const float> features,
                                                  const PixelVotes& votes,
                                                  const Progress& progress);

}  // namespace episcope
