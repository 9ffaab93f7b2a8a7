// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/disparity/common/estimator.h"
#include "engine/disparity/common/global_labeling.h"
#include "engine/disparity/plane/plane_refinement.h"
#include "engine/disparity/plane/visible_costs.h"
#include "engine/disparity/stereo/stereo_costs.h"

namespace episcope {

struct PlaneParameters {
  VisibilityParameters visibility = {};
  PlaneRefinementParameters refinement = {};
  GlobalLabelingParameters labeling{.smoothness = 1.5, .edge_strength = 20};
  StereoCostParameters matching{
      .labels = 96, .interpolation = Interpolation::Cubic, .range = {}, .view = {}};
};
[[nodiscard]] Schema<PlaneParameters> plane_pm_schema();

/// Disparity of one view from all views in which a point is visible.
///
/// 1. Matching costs of all views as in ST_AV_G, but every pixel has a cap of its own and costs
///    count in units of it (visible_costs.h), and their globally optimal labeling
///    (global_labeling.h) with g = exp(−β |∇I|).
/// 2. `rounds` times: the map is cast into every view (surfaces_in_views.h); views in which it
///    shows something nearer do not count for a point; labeling again.
/// 3. Placed between labels with planes and TGV² (plane_refinement.h).
///
/// Confidence as in ST_AV_G. Results do not depend on the number of threads. At
/// `progress.finish_requested()` the map of the last round that was finished is returned. Memory: 6
/// floats per pixel and label, 1 per ray. Throws InvalidInput as `prepare_stereo`, Cancelled.
///
/// Reference: planes by PatchMatch, Bleyer,
/// Rhemann and Rother 2011 [BRR11], TGV Bredies, Kunisch and Pock 2010 [BKP10]. Evidence:
/// tests/accuracy/tuning.md.
[[nodiscard]] Estimate estimate_planes(const LightField& light_field,
                                       const PlaneParameters& parameters, ViewSelection views,
                                       const Progress& progress);

[[nodiscard]] Estimator plane_pm_estimator();

}  // namespace episcope
