// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/parameter/schema.h"
#include "engine/disparity/plane/plane_refinement.h"

#include <string>

namespace episcope {

/// How labels are chosen before they are placed between each other.
struct JumpLabelingParameters {
  double smoothness = 0.5;    ///< α, per px of difference, in units of the cap.
  double jump = 0.3;          ///< τ / α, px: no pair of neighbours pays for more.
  double edge_strength = 20;  ///< β.
  double least_weight = 0.1;  ///< Of a pair across an edge.
  int passes = 8;
};
[[nodiscard]] Schema<JumpLabelingParameters> jump_labeling_schema();

/// Weights of pairs of neighbours, `[y][x]`: max(least, exp(−β·|difference of the two|)). Throws
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

}  // namespace episcope
