// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/light_field.h"
#include "engine/core/progress.h"
#include "engine/core/schema.h"
#include "engine/core/view_gain.h"
#include "engine/disparity/denoise.h"
#include "engine/disparity/estimator.h"
#include "engine/disparity/plane_labeling.h"
#include "engine/disparity/stereo_costs.h"
#include "engine/disparity/visible_costs.h"

namespace episcope {

/// Gains and fall-off by the ratios of the samples of corresponding points: medians over some
/// pixels of the reference, whose `disparity` is given (kNothingNear = not known), and a fall-off
/// that makes them least different. Samples in [0, 1], of which the darkest and the brightest do
/// not count. Throws Cancelled.
[[nodiscard]] PhotometricCorrection correction_of_points(const LightField& light_field,
                                                         ViewIndex reference,
                                                         ImageView<const float> disparity,
                                                         const Progress& progress);

/// Parameters of plane_pm.
struct PlaneParameters {
  VisibilityParameters visibility = {};
  PlaneRefinementParameters refinement = {};
  JumpLabelingParameters labeling = {};
  StereoCostParameters matching{
      .labels = 96, .interpolation = Interpolation::Cubic, .range = {}, .view = {}};
  bool even = true;
  bool silhouettes = true;
  IslandParameters islands = {};
};

/// Disparity from all views in which a point is visible.
///
/// 1. Matching costs of all views as in ST_AV_G, but on demand with a cap for every pixel
///    (visible_costs.h); labels under a truncated smoothness (plane_labeling.h).
/// 2. `rounds` times: views in which a sure surface of the map shows something nearer do not count
///    for a point (surfaces_in_views); labeling again. Before the first, differences in
///    brightness between the views are found and taken away, if there are any
///    (view_gain.h).
/// 3. Placed between labels with TGV², and anew where costs leave the labels in doubt
///    (plane_labeling.h). Silhouettes are moved to the edges of the view (place_silhouettes),
///    islands filled (engine/disparity/denoise.h).
/// 4. For all views, also from the outermost views, in one round: what the maps made before show
///    there occludes. The maps are carried to every view, and their majority counts
///    (carried_run.h). Beside jumps the samples of each view decide (choose_propagated_sides).
///    Views that were estimated keep their own maps.
///
/// Confidence as in ST_AV_G; of carried views, the mean of those that agree. Results do not depend
/// on the number of threads. At `progress.finish_requested()` the map of the last round that was
/// finished is returned, or carried from the views that were. Memory: 3 floats per pixel and label,
/// 1 per ray, 3 × 16 bits more where brightness differs. Throws InvalidInput as `prepare_stereo`,
/// Cancelled.
///
/// Reference: own; message passing Kolmogorov 2006 [Kol06], TGV Bredies, Kunisch and Pock 2010
/// [BKP10]. Evidence: tests/accuracy/tuning.md.
[[nodiscard]] Estimate estimate_planes(const LightField& light_field,
                                       const PlaneParameters& parameters, ViewSelection views,
                                       const Progress& progress, Device device = Device::Cpu);

[[nodiscard]] Estimator plane_pm_estimator();

}  // namespace episcope
