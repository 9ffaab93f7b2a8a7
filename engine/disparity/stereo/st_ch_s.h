// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/disparity/common/estimator.h"

namespace episcope {

/// ST_CH_S: ST_CH_L, denoised with weighted total variation (engine/disparity/common/denoise.h).
/// The profile `paper` is that of ST_CH_L without weights.
/// Reference: the paper, section 4.2, equation (4).
[[nodiscard]] Estimator st_ch_s_estimator();

}  // namespace episcope
