// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/labeling/rays/ray_labeling.h"

namespace episcope {

/// Labels of all views that minimise the energy of [WSG13] as a whole: the costs of all rays,
/// −log p; boundaries within the views, weighted by edges (λ J_st); and μ times the weight of every
/// line of a horizontal or vertical EPI on which the label changes from one view to the next
/// (μ (J_xs + J_yt)), where the point is visible in both (ray_lines.h). Relaxed to the simplex and
/// solved with a bound for the whole (engine/solvers/linked/linked_labeling.h), to
/// `parameters.gap_joint`. Energy and bound are those of the whole. Throws Cancelled.
///
/// 16 bytes a ray and label and 46 a ray: 5.5 GB for 9×9×512×512 with 13 labels.
[[nodiscard]] RayLabeling smooth_lines(const RayLabelingInput& input,
                                       const RayLabelingParameters& parameters,
                                       const Progress& progress);

/// Labels of one view, solved together with all views that have probabilities, to `parameters.gap`.
[[nodiscard]] RayLabeling smooth_lines_of_view(const RayLabelingInput& input, ViewIndex view,
                                               const RayLabelingParameters& parameters,
                                               const Progress& progress);

/// That energy of labels, ids of the probabilities, of all views that have probabilities.
[[nodiscard]] double line_energy(const RayLabelingInput& input,
                                 const RayLabelingParameters& parameters,
                                 const ViewStack<std::int32_t>& labels);

}  // namespace episcope
