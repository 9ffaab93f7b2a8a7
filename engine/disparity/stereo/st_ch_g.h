// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/disparity/common/estimator.h"

namespace episcope {

/// ST_CH_G: multi-view stereo over the views of the cross-hair, a globally optimal labeling of one
/// view with the matching costs of ST_CH_L as data term (engine/disparity/stereo/stereo_global.h).
/// Reference: the paper, equations (4) and (5).
[[nodiscard]] Estimator st_ch_g_estimator();

}  // namespace episcope
