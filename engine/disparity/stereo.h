// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/disparity/denoise.h"
#include "engine/disparity/estimator.h"
#include "engine/disparity/global_labeling.h"
#include "engine/disparity/stereo_costs.h"

namespace episcope {

/// Parameters of the local stereo methods ST_AV_L and ST_CH_L.
struct StereoLocalParameters {
  StereoCostParameters matching = {};
  Refinement refinement = Refinement::Parabola;
};

/// Parameters of the denoised ones, ST_AV_S and ST_CH_S.
struct StereoSmoothParameters {
  DenoiseParameters denoising{.lambda = 0.1, .weight_power = 2};
  double map_noise = 0.1;  ///< σ₀ of `denoise`, px.
  IslandParameters islands = {};
  StereoLocalParameters local = {};
};

/// The label of the least cost at every pixel of one view, moved between labels by `refinement`:
/// none, a parabola through the costs of the label and its neighbors, or two lines of equal slope
/// (equiangular), by half a label at most. Costs are computed band by band and never held.
///
/// Confidence: 1 − least cost / mean cost over the labels. It is near 0 where all labels are alike
/// and falls with noise, since noise raises the least cost. The ε used is reported in the notes.
/// Throws InvalidInput as `prepare_stereo`, DeviceFailure, Cancelled.
[[nodiscard]] Estimate estimate_stereo_local(const LightField& light_field, MatchedViews views,
                                             const StereoLocalParameters& parameters,
                                             const Progress& progress, Device device = Device::Cpu);

/// The local method, denoised (engine/disparity/denoise.h) and without islands
/// (engine/disparity/denoise.h); the duality gap is in the notes.
[[nodiscard]] Estimate estimate_stereo_smooth(const LightField& light_field, MatchedViews views,
                                              const StereoSmoothParameters& parameters,
                                              const Progress& progress,
                                              Device device = Device::Cpu);

/// λ under the profile `paper`.
inline constexpr double kPaperSmoothness = 0.6;

/// Parameters of ST_AV_G and ST_CH_G.
struct StereoGlobalParameters {
  GlobalLabelingParameters labeling = {};
  StereoCostParameters matching = {};
  IslandParameters islands = {};
};

/// The profile `paper` is as in the local methods (no cap or ε = 1, bilinear samples, no
/// aggregation) without edge weights and settling, and with islands. The paper does not give λ;
/// kPaperSmoothness is less than the tuned λ: without a cap, costs that many views share vary less
/// from label to label than their mean tells (tests/accuracy/tuning.md).
[[nodiscard]] Schema<StereoGlobalParameters> stereo_global_schema(MatchedViews views);

/// min Σ ρ(x, u) + λ ρ̄ Σ g |∇u| for one view: ρ the matching costs of the local methods, ρ̄ their
/// mean near each pixel's best label (visible_costs.h), whatever the range, u among the labels
/// (label_globally). Each pixel then settles
/// between labels, towards the parabola through the costs of its label and the two neighboring
/// labels, weighted by confidence², and islands are filled (engine/disparity/denoise.h).
/// Confidence: 1 − cost of the label / mean cost over the labels. β = 25: a smaller one joins the
/// background between thin structures to them. ε, energy, gap and iterations are reported in the
/// notes. Memory: 6 floats per pixel and label. Throws InvalidInput as `prepare_stereo`, Cancelled.
/// Reference: the paper, equation (5).
[[nodiscard]] Estimate estimate_stereo_global(const LightField& light_field, MatchedViews views,
                                              const StereoGlobalParameters& parameters,
                                              const Progress& progress,
                                              Device device = Device::Cpu);

// Multi-view stereo over all views (ST_AV, equation (3) of the paper) or over the cross-hair, the
// row and the column of the estimated view (ST_CH, equation (4)). All estimate one view.

/// ST_AV_L, ST_CH_L: at every pixel the label of least matching cost (estimate_stereo_local).
///
/// The profile `paper` is the method as published: no cap for the cross-hair; for all views ε =
/// 1.0, which no pixel of the paper's scenes can tell from no cap; bilinear samples, no refinement.
/// The default departs from it: ε follows the noise, samples are cubic, neighbors of similar
/// color share costs through a guided filter of radius 2, and a parabola is fitted between labels.
/// This reduces the error to about a fifth (tests/accuracy/tuning.md).
[[nodiscard]] Estimator stereo_local_estimator(MatchedViews views);

/// ST_AV_S, ST_CH_S: the local methods, denoised with weighted total variation (`denoise`), under
/// the profile `paper` without weights. Section 4.2 of the paper.
[[nodiscard]] Estimator stereo_smooth_estimator(MatchedViews views);

/// ST_AV_G, ST_CH_G: a globally optimal labeling with the same matching costs as data term
/// (estimate_stereo_global). Equation (5) of the paper.
[[nodiscard]] Estimator stereo_global_estimator(MatchedViews views);

}  // namespace episcope
