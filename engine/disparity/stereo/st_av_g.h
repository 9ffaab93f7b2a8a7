// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/disparity/common/estimator.h"

namespace episcope {

/// ST_AV_G: multi-view stereo over all views, a globally optimal labeling of one
/// view with the matching costs of ST_AV_L as data term (engine/disparity/stereo/stereo_global.h).
/// Reference: the paper, equations (3) and (5).
[[nodiscard]] Estimator st_av_g_estimator();

}  // namespace episcope
