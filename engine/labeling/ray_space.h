// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/labeling/ray_labeling.h"

namespace episcope {

/// The mode `Rays` of label_rays: fills `result.labels` with layers of the probabilities. Throws
/// Cancelled. Precondition: the input was checked.
void label_ray_space(const RayLabelingInput& input, const RayLabelingParameters& parameters,
                     const Progress& progress, RayLabeling& result);

}  // namespace episcope
