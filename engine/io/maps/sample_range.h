// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/light_field/light_field.h"
#include "engine/core/light_field/scene.h"

#include <string>

namespace episcope::io {

/// Brings samples into the range that the engine works in, 0 … 1 of floats and all of what integers
/// can hold, and tells `report` if they were in another one. `levels`: the values of black and
/// white as stored, "0,1023"; empty = found:
/// - float: `scale_float_samples`;
/// - uint16 of which none exceeds 255: samples of 8 bits, which become uint8; none exceeds 1023, or
///   4095: samples of 10 or 12 bits, as cameras write them; of 14 bits, if the largest is
///   above 9000 (well above what 13 bits hold) and none exceeds 16383. Views that are read from
///   their file stay as they are.
///
/// Integers stay integers, rounded to the nearest. Throws InvalidInput for other `levels`.
void settle_range(LightField::Samples& samples, const std::string& levels,
                  ConventionReport& report);

/// The largest value of samples of 8, 10, 12 or 16 bits, the fewest that hold `largest`.
[[nodiscard]] int full_scale(double largest);

}  // namespace episcope::io
