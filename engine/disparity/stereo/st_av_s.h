// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/disparity/common/estimator.h"

namespace episcope {

/// ST_AV_S: ST_AV_L, denoised with weighted total variation (engine/disparity/common/denoise.h).
/// The profile `paper` is that of ST_AV_L without weights.
/// Reference: the paper, section 4.2, equation (3).
[[nodiscard]] Estimator st_av_s_estimator();

}  // namespace episcope
