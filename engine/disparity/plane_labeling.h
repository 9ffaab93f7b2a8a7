// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/light_field.h"
#include "engine/core/progress.h"
#include "engine/core/schema.h"
#include "engine/disparity/visible_costs.h"

#include <string>

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

/// How labels are chosen before they are placed between each other.
struct JumpLabelingParameters {
  double smoothness = 0.5;    ///< α, per px of difference, in units of the cap.
  double jump = 0.3;          ///< τ / α, px: no pair of neighbors pays for more.
  double edge_strength = 20;  ///< β.
  double least_weight = 0.1;  ///< Of a pair across an edge.
  int passes = 8;
};
[[nodiscard]] Schema<JumpLabelingParameters> jump_labeling_schema();

/// Weights of pairs of neighbors, `[y][x]`: max(least, exp(−β·|difference of the two|)). Throws
/// Cancelled.
struct PairWeights {
  Image<float> across, down;
};
[[nodiscard]] PairWeights pair_weights(const LightField& light_field, ViewIndex view, double beta,
                                       double least, const Progress& progress);

/// Labels by a smoothness that is truncated (engine/solvers/messages); writes each pixel at the
/// parabola through its label's cost and those beside it. Returns a note. Throws DeviceFailure,
/// Cancelled.
std::string label_with_jumps(const PlaneRefinementData& data, const PairWeights& weights,
                             const JumpLabelingParameters& parameters, const Progress& progress,
                             ImageView<float> disparity);

/// Moves silhouettes to the edges of the view: each pixel within 3 px of a jump of `disparity` (by
/// more than 0.2 px between neighbors) takes the median of the 9×9 px around it, weighted by
/// exp(−|ΔI|²/2σ²), |ΔI| the Euclidean difference of samples in [0, 1], σ a quarter of their spread
/// over the view, at most 0.08, and by exp(−r²/2ρ²), ρ = 1.7 px. Pixels that are not valid neither
/// count nor change. Evidence: tests/accuracy/tuning.md. Throws Cancelled.
void place_silhouettes(const LightField& light_field, ViewIndex view, const Progress& progress,
                       ImageView<float> disparity);

}  // namespace episcope
