// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/light_field/disparity_field.h"
#include "engine/core/light_field/light_field.h"

#include <string>

namespace episcope::io {

/// Marks pixels of disparity exactly `zero` (0 as stored) as invalid, in all views, if at view `at`
/// the neighbouring views contradict them, though they agree with the rest: many programs write 0
/// where nothing is known. Returns what a warning says after the name of the map, or nothing.
/// Linear in the pixels.
[[nodiscard]] std::string drop_unknown_zeros(const LightField::Samples& samples, ViewIndex at,
                                             float zero, DisparityField& field);

}  // namespace episcope::io
