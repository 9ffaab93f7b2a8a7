// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/labeling/rays/ray_labeling.h"

namespace episcope {

/// Labels of all views, and of one view: boundaries within a view cost their length, weighted by
/// edges (J_st of [WSG13]); views are independent. Disparities speed it up: a view then starts from
/// the result of its neighbour (solve_views). Energy and bound are sums over the views. Throws
/// Cancelled.
[[nodiscard]] RayLabeling smooth_views(const RayLabelingInput& input,
                                       const RayLabelingParameters& parameters,
                                       const Progress& progress);
[[nodiscard]] RayLabeling smooth_view(const RayLabelingInput& input, ViewIndex view,
                                      const RayLabelingParameters& parameters,
                                      const Progress& progress);

}  // namespace episcope
