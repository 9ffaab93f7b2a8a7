// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/labeling/rays/ray_labeling.h"

namespace episcope {

/// Labels of all views that agree along the rays. The energy is that of [WSG13]: per-view
/// TV weighted by edges (J_st), variation along the lines of horizontal and vertical EPIs
/// (J_xs, J_yt) and one label for each ray, relaxed to the simplex.
///
/// It is done in two steps. Each view is solved by itself
/// (engine/solvers/simplex/simplex_labeling.h), the cost of a ray being the mean over the rays of
/// the same scene point in the nearest 5×5 views, as far as their colours agree (label_costs.h):
/// mistakes of single rays average out. Then the rays of a scene point vote twice on their label
/// along their EPIs (ray_vote.h), which makes labels constant along lines where the views left them
/// different.
///
/// Why: a finite μ has 8 floats for each ray and label, 8 GB for 9×9×512×512 with 13 labels. The
/// limit μ → ∞, one unknown for each scene point, carried from five views solved to all others, is
/// as quick, but carries labels along wrong disparities too: right / consistent, percent, of views
/// each smoothed alone | of that | of this: demo 256 px with estimate 93.79 / 98.98 | 93.34 / 99.41
/// | 93.87 / 99.25, with image 95.79 / 99.29 | 95.65 / 99.63 | 95.87 / 99.52; objects
/// 99.913 / 99.89 | 99.888 / 99.88 | 99.914 / 99.91; a rendered still life with estimate
/// 96.75 / 99.37 | 96.56 / 99.52 | 96.76 / 99.54, with image 94.94 / 99.47 | 94.90 / 99.7
/// | 94.98 / 99.70. Costs averaged over all 81 views or those of the ray's EPIs did no better.
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
