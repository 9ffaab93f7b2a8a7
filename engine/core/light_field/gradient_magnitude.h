// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/light_field/light_field.h"

namespace episcope {

/// |∇I| of one view, `[y][x]` ≥ 0 per px: the norm of the forward differences over all channels,
/// samples in [0, 1]; nothing beyond the last row and column. `out` has the size of a view.
void gradient_magnitude(const LightField& light_field, ViewIndex view, ImageView<float> out);

}  // namespace episcope
