// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/light_field/disparity_field.h"

namespace episcope {

/// The disparity of a view as the view `step` further sees it, through a z-buffer: each pixel moves
/// by −d·step to the nearest pixel, the nearest surface wins; those at the border go on outside.
/// Pixels that none reaches are NaN, but cracks of one pixel between neighbours on both sides whose
/// disparities agree within `tolerance_px` are closed, also where a farther surface shines through.
/// A step of zero copies. Invalid pixels become NaN.
[[nodiscard]] Image<float> warp_disparity(const DisparityView& source, ViewIndex step,
                                          double tolerance_px);

}  // namespace episcope
