// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/light_field.h"
#include "engine/core/scene.h"

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

/// Brings float samples into the range that the engine works in and tells `report`. If one in a
/// hundred is clearly negative, they are brought from -1 … 1, or if they exceed that from their
/// quantiles of 0.1 and 99.9 %, to 0 … 1, unless the negative ones are noise around black: not far
/// below 0, and single ones. None beyond 1.5: as they are. Others are samples of 8,
/// 10, 12 or 16 bits (`full_scale`) if most are whole numbers, or, if half of them exceed 2 % of
/// that range as after resampling, of 8 bits, beyond 255.5 of 16: they are divided by it. Else they
/// are linear with highlights (HDR): divided by their quantile of 99.9
/// %, if that exceeds 1.5, so that only highlights exceed 1. Zeros do not count, and up to a
/// million are looked at. Integers stay as they are.
void scale_float_samples(LightField::Samples& samples, ConventionReport& report);

/// Turns samples that are NaN or infinite into 0 and tells `report` how many. To be called after
/// the order of views was checked, which bridges such samples.
void zero_nonfinite_samples(LightField::Samples& samples, ConventionReport& report);

}  // namespace episcope::io
