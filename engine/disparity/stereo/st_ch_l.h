// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/disparity/common/estimator.h"

namespace episcope {

/// ST_CH_L: multi-view stereo over the views of the cross-hair, local: at every pixel of one view
/// the label of the least matching cost (engine/disparity/common/matching_cost.h, stereo_local.h).
///
/// The profile `paper` is the method as published (no cap, bilinear samples, no
/// refinement). The default departs from it: ε follows the noise, cubic samples, costs shared among
/// neighbours of like colour by a guided filter of radius 2, a parabola between labels. On the
/// built-in scenes, still_life and cotton that divides the error by about five.
/// Reference: the paper, equation (4).
[[nodiscard]] Estimator st_ch_l_estimator();

}  // namespace episcope
