// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/disparity/common/estimator.h"
#include "engine/disparity/common/global_labeling.h"
#include "engine/disparity/common/islands.h"
#include "engine/disparity/stereo/stereo_costs.h"

namespace episcope {

/// λ under the profile `paper`.
inline constexpr double kPaperSmoothness = 0.6;

/// Parameters of ST_AV_G and ST_CH_G.
struct StereoGlobalParameters {
  GlobalLabelingParameters labeling = {};
  StereoCostParameters matching = {};
  IslandParameters islands = {};
};

/// The profile `paper` is that of the local methods (no cap or ε = 1, bilinear samples, no
/// aggregation) without edge weights and settling, and with islands. The paper does not give λ;
/// kPaperSmoothness is less than the tuned λ: without a cap, costs that many views share vary less
/// from label to label than their mean tells (tests/accuracy/tuning.md).
[[nodiscard]] Schema<StereoGlobalParameters> stereo_global_schema(MatchedViews views);

/// min Σ ρ(x, u) + λ ρ̄ Σ g |∇u| for one view: ρ the matching costs of the local methods, ρ̄ their
/// mean near each pixel's best label (cost_unit.h), whatever the range, u among the labels
/// (label_globally). Each pixel then settles
/// between labels, towards the parabola through the costs of its label and the two neighbouring
/// labels, weighted by confidence², and islands are filled (engine/disparity/common/islands.h).
/// Confidence: 1 − cost of the label / mean cost over the labels. β = 25: a smaller one joins the
/// background between thin structures to them. ε, energy, gap and iterations are reported in the
/// notes. Memory: 6 floats per pixel and label. Throws InvalidInput as `prepare_stereo`, Cancelled.
/// Reference: the paper, equation (5).
[[nodiscard]] Estimate estimate_stereo_global(const LightField& light_field, MatchedViews views,
                                              const StereoGlobalParameters& parameters,
                                              const Progress& progress,
                                              Device device = Device::Cpu);

}  // namespace episcope
