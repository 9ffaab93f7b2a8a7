// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/disparity/estimator.h"
#include "engine/disparity/global_labeling.h"
#include "engine/disparity/stereo_costs.h"

namespace episcope {

/// Parameters of ST_AV_G and ST_CH_G.
struct StereoGlobalParameters : StereoCostParameters, GlobalLabelingParameters {};

/// The profile `paper` is that of the local methods (no cap or ε = 1, bilinear samples, no
/// aggregation) without edge weights and settling.
[[nodiscard]] Schema<StereoGlobalParameters> stereo_global_schema(MatchedViews views);

/// min Σ ρ(x, u) + λ ρ̄ Σ g |∇u| for one view: ρ the matching costs of the local methods, ρ̄ their
/// mean over all pixels and labels, u among the labels (label_globally). Then each pixel settles
/// between labels: towards the parabola through the costs of its label and the neighbours', trusted
/// by confidence². Confidence: 1 − cost of the label / mean cost over the labels.
/// ε, energy, gap and iterations are in the notes. Takes 6 floats for each pixel and label.
/// Throws InvalidInput as `prepare_stereo`, Cancelled.
/// Reference: the paper, equation (5).
[[nodiscard]] Estimate estimate_stereo_global(const LightField& light_field, MatchedViews views,
                                              const StereoGlobalParameters& parameters,
                                              const Progress& progress);

}  // namespace episcope
