// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/disparity_field.h"
#include "engine/core/progress.h"
#include "engine/labeling/ray_labeling.h"

#include <cstdint>

namespace episcope {

/// Labels of all views after each ray has taken the label that most rays of its scene point have:
/// the rays in the same row and column of the camera grid, along the lines of the horizontal and
/// vertical EPI through it, where the point is visible
/// (engine/labeling/ray_labeling.h). A vote is weighted by the trust in its color
/// (engine/labeling/ray_labeling.h); the ray's own label counts 1 and wins ties. Rays of all
/// other views do not vote: they would spread errors of whole regions.
///
/// The layers `labels` are 0 … `label_count` − 1. Takes (v + u − 1)·rays steps. Precondition:
/// `disparity` and `colors` hold all views with labels. Throws Cancelled.
struct RayVotes {
  int label_count = 0;
  const DisparityField& disparity;
  const RayColors& colors;
  const RayLabelingInput* input = nullptr;  ///< Whose strokes rounds of votes keep; null = none.
};
[[nodiscard]] ViewStack<std::int32_t> vote_along_rays(const ViewStack<std::int32_t>& labels,
                                                      const RayVotes& votes,
                                                      const Progress& progress);
/// Votes again, faster: only rays vote whose evidence has changed since `before`, from which
/// `labels` came by a vote.
[[nodiscard]] ViewStack<std::int32_t> vote_again_along_rays(const ViewStack<std::int32_t>& before,
                                                            const ViewStack<std::int32_t>& labels,
                                                            const RayVotes& votes,
                                                            const Progress& progress);

/// The rays whose vote (engine/labeling/ray_vote.h) may change because labels have: 1 for rays
/// whose own label differs between `before` and `after`, and for all in the same row and column of
/// the camera grid that may see the point of one that does, else 0. Some more are marked: where a
/// ray arrives is known to as many pixels as the disparities of one point may differ
/// (engine/labeling/ray_labeling.h). Precondition: `disparity` holds all views with labels.
/// Throws Cancelled.
[[nodiscard]] ViewStack<std::uint8_t> changed_rays(const ViewStack<std::int32_t>& before,
                                                   const ViewStack<std::int32_t>& after,
                                                   const DisparityField& disparity,
                                                   const Progress& progress);

}  // namespace episcope
