// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/light_field/disparity_field.h"
#include "engine/core/parallel/progress.h"
#include "engine/labeling/rays/ray_colors.h"

#include <cstdint>

namespace episcope {

/// Labels of all views after each ray has taken the label that most rays of its scene point have:
/// the rays in the same row and column of the camera grid, along the lines of the horizontal and
/// vertical EPI through it, as far as the point is visible there
/// (engine/labeling/rays/ray_targets.h). A vote is weighted by the trust in its colour
/// (engine/labeling/rays/ray_colors.h); the ray's own label counts 1 and wins ties. Rays of all
/// other views do not vote: they would spread errors of whole regions.
///
/// The layers `labels` are 0 … `label_count` − 1. Takes (v + u − 1)·rays steps. Precondition:
/// `disparity` and `colors` hold all views with labels. Throws Cancelled.
struct RayVotes {
  int label_count = 0;
  const DisparityField& disparity;
  const RayColors& colors;
};
[[nodiscard]] ViewStack<std::int32_t> vote_along_rays(const ViewStack<std::int32_t>& labels,
                                                      const RayVotes& votes,
                                                      const Progress& progress);
/// The same, sooner: only rays vote for which labels have changed since `before`, from which
/// `labels` came by a vote.
[[nodiscard]] ViewStack<std::int32_t> vote_again_along_rays(const ViewStack<std::int32_t>& before,
                                                            const ViewStack<std::int32_t>& labels,
                                                            const RayVotes& votes,
                                                            const Progress& progress);

}  // namespace episcope
