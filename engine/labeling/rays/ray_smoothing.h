// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/labeling/rays/ray_labeling.h"

namespace episcope {

/// Labels of all views that are consistent along the rays. The energy is that of [WSG13]: per-view
/// TV weighted by edges (J_st), variation along the lines of horizontal and vertical EPIs (J_xs,
/// J_yt) and one label per ray, relaxed to the simplex.
///
/// It is minimised in two steps. Each view is solved by itself
/// (engine/solvers/simplex/simplex_labeling.h), the cost of a ray being the mean over the rays of
/// the same scene point in the nearest 5×5 views, as far as their colours agree (label_costs.h):
/// errors of single rays average out. Then the rays of a scene point vote twice on their label
/// along their EPIs (ray_vote.h), which makes labels constant along lines where the views had left
/// them different.
///
/// Why: a finite μ needs 8 floats per ray and label, 8 GB for 9×9×512×512 with 13 labels. The limit
/// μ → ∞, one unknown per scene point, carried from five views to all others, is as quick but also
/// carries labels along wrong disparities (tests/accuracy/tuning.md).
/// Energy and bound are sums over the views as solved, before the vote. Throws Cancelled.
[[nodiscard]] RayLabeling smooth_rays(const RayLabelingInput& input,
                                      const RayLabelingParameters& parameters,
                                      const Progress& progress);

/// Labels of one view, the cost of a ray being the mean over all views that have probabilities;
/// there is no vote.
[[nodiscard]] RayLabeling smooth_rays_of_view(const RayLabelingInput& input, ViewIndex view,
                                              const RayLabelingParameters& parameters,
                                              const Progress& progress);

}  // namespace episcope
