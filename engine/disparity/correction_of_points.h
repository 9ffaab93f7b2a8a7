// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/light_field.h"
#include "engine/core/photometric_correction.h"
#include "engine/core/progress.h"

namespace episcope {

/// Gains and fall-off by the ratios of the samples of corresponding points: medians over some
/// pixels of the reference, whose `disparity` is given (kNothingNear = not known), and a fall-off
/// that makes them least different. Samples in [0, 1], of which the darkest and the brightest do
/// not count. Throws Cancelled.
[[nodiscard]] PhotometricCorrection correction_of_points(const LightField& light_field,
                                                         ViewIndex reference,
                                                         ImageView<const float> disparity,
                                                         const Progress& progress);

}  // namespace episcope
