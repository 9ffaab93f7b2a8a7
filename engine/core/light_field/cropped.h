// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/array/pixel_rect.h"
#include "engine/core/light_field/light_field.h"
#include "engine/core/parallel/progress.h"

namespace episcope {

/// The same pixels of every view as a light field of its own, samples in their stored type.
/// Precondition: `part` is not empty and lies within the views. Throws Cancelled.
[[nodiscard]] LightField cropped(const LightField& light_field, const PixelRect& part,
                                 const Progress& progress);

}  // namespace episcope
