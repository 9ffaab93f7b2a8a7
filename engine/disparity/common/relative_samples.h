// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/light_field/light_field.h"
#include "engine/core/parallel/progress.h"

namespace episcope {

/// The light field with every sample relative to its surroundings: half of its ratio to the mean of
/// its channel over (2·radius + 1)² pixels of the same view, at most 1, stored in 16 bits. A gain
/// of a view, or one that varies slowly over it, changes nothing. Windows end at the border;
/// invalid pixels enter no mean. In the dark, where the mean is below 0.02, samples grow less. What
/// is left out is the brightness of whole regions. Takes 2 bytes a sample. Throws Cancelled.
[[nodiscard]] LightField relative_samples(const LightField& light_field, int radius,
                                          const Progress& progress);

}  // namespace episcope
