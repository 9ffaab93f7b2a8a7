// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/light_field/light_field.h"
#include "engine/core/parallel/progress.h"
#include "engine/disparity/stereo/stereo_costs.h"

namespace episcope {

/// Replaces the guide of an aggregation, if there is one, by one of the same radius that keeps
/// whatever contrast is not noise: its regularization is 3·10⁻⁵ + 2σ², σ² the median over the view
/// of the noise variance that `costs` know of. That of prepare_stereo, 10⁻³, averages across
/// silhouettes of less than 0.03 of contrast, which is most of a dark view. Throws Cancelled.
void set_fine_guide(const LightField& light_field, const Progress& progress, StereoCosts& costs);

}  // namespace episcope
