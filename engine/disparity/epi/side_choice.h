// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/light_field/estimate.h"
#include "engine/core/parallel/progress.h"
#include "engine/disparity/common/packed_views.h"

namespace episcope {

/// Decides for every ray near a jump of disparity to which side of it the ray belongs. The window
/// of a structure tensor that straddles a silhouette reports the foreground's disparity for pixels
/// of the background (foreground fattening), where a line of the background is visible in half of
/// the views only.
///
/// Besides its own disparity d, a ray can take the least or the largest of those of 12 neighbours,
/// 3 px away in the eight directions of the grid (diagonally 3 in x and y) and 6 px away in four;
/// the least only of those that have 0.2 times its confidence.
/// Each of the three is judged by the residuals of its map (LineResiduals, which sees lines by
/// halves), at most 3·(n² + 1/255²), summed over 5×5 pixels with weights (1 − t/4)⁴,
/// t = |difference of colour|²/(2σ²), σ² = (8/255)² + 2n², 0 where t > 4; n² is the median residual
/// of the centre view (residual_noise). The far side wins if its sum is below 0.95 of the own one
/// and not above the near one's, else the near side if its sum is below 0.8 of the own one: windows
/// fatten the foreground, not the background. Sides less than 0.2 px from d do not count. The ray
/// takes disparity and confidence of the winner. A ray that stays more than 0.5 px in front of the
/// far side keeps its confidence only as far as the lines tell: 0.25 + 1.5·(far/own − 1) of it, at
/// most all, far and own being the sums. All rays are judged by the
/// estimate before the call, so the order of processing does not matter.
///
/// `estimate.field` and `estimate.confidence` cover the centre view. Throws Cancelled. Evidence:
/// tests/accuracy/tuning.md.
void choose_sides(const PackedViews& packed_views, Estimate& estimate, const Progress& progress);

/// The same for maps of any views, given the noise n².
void choose_sides(const PackedViews& packed_views, float noise, ViewStack<float>& disparity,
                  ViewStack<float>& confidence, const Progress& progress);

}  // namespace episcope
