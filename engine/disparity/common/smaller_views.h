// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/light_field/light_field.h"
#include "engine/core/parallel/progress.h"

namespace episcope {

/// The views in the row and the column of the centre view, each sample the mean of `factor` ×
/// `factor` pixels, as uint16: noise is `factor` times weaker, disparities are `factor` times
/// smaller. The other views are black. Blocks that the border or an invalid pixel cuts are left
/// out or not valid. Precondition: factor ≤ height and width. Throws Cancelled.
[[nodiscard]] LightField smaller_views(const LightField& light_field, int factor,
                                       const Progress& progress);

}  // namespace episcope
