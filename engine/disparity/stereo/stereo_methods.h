// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/disparity/common/estimator.h"

namespace episcope {

// Multi-view stereo over all views (ST_AV, equation (3) of the paper) or over those of the row and
// the column of the estimated view, the cross-hair (ST_CH, equation (4)). All estimate one view.

/// ST_AV_L, ST_CH_L: at every pixel the label of least matching cost
/// (engine/disparity/stereo/stereo_local.h).
///
/// The profile `paper` is the method as published: no cap for the cross-hair; for all views ε =
/// 1.0, which no pixel of the paper's scenes can tell from no cap; bilinear samples, no refinement.
/// The default departs from it: ε follows the noise, samples are cubic, neighbours of similar
/// colour share costs through a guided filter of radius 2, and a parabola is fitted between labels.
/// This reduces the error to about a fifth (tests/accuracy/tuning.md).
[[nodiscard]] Estimator st_av_l_estimator();
[[nodiscard]] Estimator st_ch_l_estimator();

/// ST_AV_S, ST_CH_S: the same, denoised with weighted total variation
/// (engine/disparity/common/denoise.h), under the profile `paper` without weights. Section 4.2 of
/// the paper.
[[nodiscard]] Estimator st_av_s_estimator();
[[nodiscard]] Estimator st_ch_s_estimator();

/// ST_AV_G, ST_CH_G: a globally optimal labeling with the same matching costs as data term
/// (engine/disparity/stereo/stereo_global.h). Equation (5) of the paper.
[[nodiscard]] Estimator st_av_g_estimator();
[[nodiscard]] Estimator st_ch_g_estimator();

}  // namespace episcope
