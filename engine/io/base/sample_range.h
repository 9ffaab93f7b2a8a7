// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/indices.h"
#include "engine/core/light_field.h"
#include "engine/core/scene.h"

#include <string>

namespace episcope::io {

/// The stored values of black and white: "0,1023". Throws InvalidInput for another text.
[[nodiscard]] Interval parse_levels(const std::string& text);

/// Maps samples to the range of the engine: 0 … 1 for floats, the full range for integers. Tells
/// `report` of any change. `levels`: stored values of black and white, "0,1023"; if empty, they are
/// detected:
/// - float: `scale_float_samples`;
/// - uint16 of which none exceeds 255: samples of 8 bits, which become uint8; none exceeds 1023, or
///   4095: samples of 10 or 12 bits, as cameras write them; of 14 bits, if the largest is above
///   9000 (well above what 13 bits hold) and none exceeds 16383. Views mapped from their file stay
///   as they are.
///
/// Integers stay integers, rounded to the nearest. Returns what `scale_float_samples` does, false
/// with `levels`. Throws InvalidInput for other `levels`.
bool settle_range(LightField::Samples& samples, const std::string& levels,
                  ConventionReport& report);

/// Largest value of the smallest sample depth (8, 10, 12 or 16 bits) that holds `largest`.
[[nodiscard]] int full_scale(double largest);

/// Maps float samples to 0 … 1 and tells `report`. If one in a hundred is clearly negative, -1 … 1
/// is mapped to 0 … 1, or the quantiles of 0.1 and 99.9 % if samples exceed that. Single samples
/// slightly below 0 are noise around black and do not count. Samples up to 1.5 stay. Larger ones
/// are divided by the full scale of 8, 10, 12 or 16 bits (`full_scale`) if most are whole numbers.
/// Resampled ones, half of which exceed 2 % of that range, are divided by 255, or by 65535 if one
/// exceeds 255.5. Others are linear with highlights (HDR): they are divided by their quantile of
/// 99.9 % if that exceeds 1.5, so that only highlights exceed 1. Zeros do not count; up to a
/// million samples are looked at. Integers stay as they are. Returns whether views are rather
/// disparity maps: floats of one channel, clearly negative or above 1.5 and not whole, but none
/// beyond 64.
bool scale_float_samples(LightField::Samples& samples, ConventionReport& report);

/// A mask of pixels, all of them valid (1).
[[nodiscard]] ViewStack<std::uint8_t> all_valid(GridShape grid, int height, int width);

/// Sets NaN and infinite samples to 0, marks their pixels as invalid (`valid`: 0 = invalid, empty =
/// all are valid) and tells `report` how many. To be called after the check of the order of views,
/// which bridges such samples.
void drop_nonfinite_samples(LightField::Samples& samples, ViewStack<std::uint8_t>& valid,
                            ConventionReport& report);

}  // namespace episcope::io
