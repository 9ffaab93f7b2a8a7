// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/parameter/schema.h"
#include "engine/disparity/plane/label_costs.h"

namespace episcope {

/// How a labeling is placed between its labels.
struct PlaneRefinementParameters {
  double tgv = 0.1;
  double doubt = 0.3;
  double leeway = 0.1;
  double bend = 2;
  int tgv_iterations = 100;
};
[[nodiscard]] Schema<PlaneRefinementParameters> plane_refinement_schema();

/// The data of one view.
struct PlaneRefinementData {
  const LabelCosts& costs;       ///< Where they are, all is computed.
  ImageView<const float> edges;  ///< Weights of the variation, `[y][x]`.
  double scale = 1;              ///< Unit of the smoothness: the mean cost.
};

/// Places a map of labels between them, in place: each pixel's parabola through the costs of its
/// nearest label and the two beside it, denoised by TGV² (engine/solvers/tgv_l2) with the square of
/// its trust as weight, by at most one label. Each pixel's own best label, denoised, is taken
/// instead where the mean trust of a region is below `doubt` (kept in full at 1.5 times that) and
/// the two differ by more than `leeway` px (in full at twice that): within it the labeling is
/// finer, beyond it often a whole region is wrong, or a silhouette has grown over its surroundings.
/// At `progress.finish_requested()` what is left is skipped. Throws Cancelled.
void refine_by_planes(const PlaneRefinementData& data, const PlaneRefinementParameters& parameters,
                      const Progress& progress, ImageView<float> disparity);

}  // namespace episcope
