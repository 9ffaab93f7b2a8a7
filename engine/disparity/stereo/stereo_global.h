// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/disparity/common/estimator.h"
#include "engine/disparity/common/global_labeling.h"
#include "engine/disparity/stereo/stereo_costs.h"

namespace episcope {

/// Share of λ that counts under the profile `paper`.
inline constexpr double kPaperSmoothness = 0.2;

/// Parameters of ST_AV_G and ST_CH_G.
struct StereoGlobalParameters {
  GlobalLabelingParameters labeling = {};
  StereoCostParameters matching = {};
};

/// The profile `paper` is that of the local methods (no cap or ε = 1, bilinear samples, no
/// aggregation) without edge weights and settling, and its λ, which the paper does not give, counts
/// kPaperSmoothness of what it says: without a cap costs rise farther from their minimum, so that
/// their mean says less of how steep it is. Error (MSE × 100) at an effective λ of 0.25, 0.5, 1.5
/// on `demo`, a rendered still life and a scene of the 2016 benchmark:
/// ST_CH_G 1.19, 1.82, 3.08; 1.18, 1.86, 3.16; 1.19, 2.56, 4.96,
/// ST_AV_G 1.38, 1.94, 4.22; 1.37, 2.03, 4.73; 1.37, 2.64, 6.71.
[[nodiscard]] Schema<StereoGlobalParameters> stereo_global_schema(MatchedViews views);

/// min Σ ρ(x, u) + λ ρ̄ Σ g |∇u| for one view: ρ the matching costs of the local methods, ρ̄ their
/// mean over all pixels and labels, u among the labels (label_globally). Then each pixel settles
/// between labels: towards the parabola through the costs of its label and the neighbours', trusted
/// by confidence². Confidence: 1 − cost of the label / mean cost over the labels.
/// β = 20 as in ST_*_S: with 10, background between blades and twigs is joined to them (MSE×100 of
/// a rendered thicket 13.7, with 20 9.7; of cotton 1.85, 0.67; of a noisy scene .16, .21). ε,
/// energy, gap and iterations are in the notes. Takes 6 floats for each pixel and label. Throws
/// InvalidInput as `prepare_stereo`, Cancelled. Reference: the paper, equation (5).
[[nodiscard]] Estimate estimate_stereo_global(const LightField& light_field, MatchedViews views,
                                              const StereoGlobalParameters& parameters,
                                              const Progress& progress);

}  // namespace episcope
