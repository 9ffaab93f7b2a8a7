// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/array/image.h"
#include "engine/core/parallel/progress.h"
#include "engine/labeling/features/label_surfaces.h"
#include "engine/labeling/features/stroke_distance.h"
#include "engine/labeling/forest/pixel_votes.h"
#include "engine/labeling/label_probabilities.h"

namespace episcope {

/// What is known about the pixels of a view besides their features.
struct StrokeEvidence {
  const StrokeDistances& distances;
  double nearness = 0;
  const LabelSurfaces* surfaces = nullptr;  ///< Null = no disparity to compare.
  /// Painted on this view itself: labels there are certain. Empty = none.
  ImageView<const std::int32_t> painted{};
};

/// The votes of the forest for each pixel of a view, weighted by what else is known. Throws
/// Cancelled.
[[nodiscard]] ProbabilityMap predict_view(const PixelVotes& votes, const StrokeEvidence& evidence,
                                          const Progress& progress);

}  // namespace episcope
