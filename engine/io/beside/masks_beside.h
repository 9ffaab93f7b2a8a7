// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/io/beside/beside_views.h"

namespace episcope::io {

/// Reads masks beside views: of valid and of invalid pixels, which go to the validity of `truth`'s
/// disparity, and regions of the centre view (`region_name`). Masks of views without disparity and
/// such that leave nothing valid are left out. Throws Cancelled.
void read_masks_beside(const std::vector<MapSet>& sets, const BesideViews& views,
                       const BesideNotes& notes, GroundTruth& truth);

}  // namespace episcope::io
