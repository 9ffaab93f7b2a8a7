// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/light_field/light_field.h"

namespace episcope::capture {

/// A view for matching: grey, in units of 1/255, smoothed by a Gaussian of 0.8 px, so that noise
/// and interpolation do not draw matches to whole pixels.
[[nodiscard]] Image<float> grey_view(const LightField& field, ViewIndex view);

}  // namespace episcope::capture
