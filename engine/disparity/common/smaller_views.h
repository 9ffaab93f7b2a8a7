// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/light_field/light_field.h"
#include "engine/core/parallel/progress.h"

namespace episcope {

/// Which views are made smaller: those in the row and the column of the centre view, or all.
enum class ReducedViews { CrossHair, All };

/// Views of which each sample is the mean of `factor` × `factor` pixels, as uint16: noise is
/// `factor` times weaker, disparities are `factor` times smaller. Other views are black. Blocks
/// that the border or an invalid pixel cuts are left out or not valid. Precondition: factor ≤
/// height and width. Throws Cancelled.
[[nodiscard]] LightField smaller_views(const LightField& light_field, int factor,
                                       const Progress& progress,
                                       ReducedViews reduced = ReducedViews::CrossHair);

}  // namespace episcope
