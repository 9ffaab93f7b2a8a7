// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/light_field/disparity_field.h"
#include "engine/core/parallel/progress.h"

#include <cstdint>

namespace episcope {

/// The rays whose vote (engine/labeling/rays/ray_vote.h) may change because labels have: 1 for rays
/// whose own label differs between `before` and `after`, and for all in the same row and column of
/// the camera grid that may see the point of one that does, else 0. Some more are marked: where a
/// ray arrives is known to as many pixels as the disparities of one point may differ
/// (engine/labeling/rays/ray_targets.h). Precondition: `disparity` holds all views with labels.
/// Throws Cancelled.
[[nodiscard]] ViewStack<std::uint8_t> changed_rays(const ViewStack<std::int32_t>& before,
                                                   const ViewStack<std::int32_t>& after,
                                                   const DisparityField& disparity,
                                                   const Progress& progress);

}  // namespace episcope
