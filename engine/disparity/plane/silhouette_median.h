// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/light_field/light_field.h"
#include "engine/core/parallel/progress.h"

namespace episcope {

/// Moves silhouettes to the edges of the view: each pixel within 3 px of a jump of `disparity` (by
/// more than 0.2 px between neighbours) takes the median of the 9×9 px around it, weighted by
/// exp(−|ΔI|²/2σ²), |ΔI| the Euclidean difference of samples in [0, 1], σ a quarter of their spread
/// over the view, at most 0.08, and by exp(−r²/2ρ²), ρ = 1.7 px. Pixels that are not valid neither
/// count nor change. Evidence: tests/accuracy/tuning.md. Throws Cancelled.
void place_silhouettes(const LightField& light_field, ViewIndex view, const Progress& progress,
                       ImageView<float> disparity);

}  // namespace episcope
