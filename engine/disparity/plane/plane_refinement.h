// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/array/volume.h"
#include "engine/core/parameter/schema.h"
#include "engine/disparity/stereo/stereo_costs.h"

namespace episcope {

/// How a labeling is placed between its labels.
struct PlaneRefinementParameters {
  int sweeps = 0;
  double plane_smoothness = 1.5;
  double truncation = 0.5;
  double reach = 0.1;
  double tgv = 0.1;
  double doubt = 0.1;
  double bend = 2;
  int tgv_iterations = 100;
};
[[nodiscard]] Schema<PlaneRefinementParameters> plane_refinement_schema();

/// The data of one view.
struct PlaneRefinementData {
  const StereoCosts& stereo;
  VolumeView<const float> costs;
  const Image<float>& means;     ///< Of the costs over the labels.
  ImageView<const float> edges;  ///< Weights of the variation, `[y][x]`.
  double scale = 1;              ///< Unit of the smoothness: the mean cost.
};

/// Refines a map of labels in place: PatchMatch over planes (engine/solvers/planes), whose result
/// is taken where it stays within `reach` px of the map, since its local moves shift jumps less
/// well than the global labeling placed them; then each pixel's parabola through the costs of its
/// nearest label and the two beside it, denoised by TGV² (engine/solvers/tgv_l2) with the
/// square of its trust as weight, by at most one label. Where the mean trust of a region is below
/// `doubt` (in full at 1.5 times that), each pixel's own best label, denoised, is taken instead. At
/// `progress.finish_requested()` what is left is skipped. Throws Cancelled.
void refine_by_planes(const PlaneRefinementData& data, const PlaneRefinementParameters& parameters,
                      const Progress& progress, ImageView<float> disparity);

}  // namespace episcope
