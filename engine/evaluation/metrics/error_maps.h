// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/evaluation/metrics/metrics.h"

namespace episcope {

/// Maps of an evaluation, from the very errors that its numbers were computed from. What
/// `evaluation.judged` leaves out belongs to no map.

/// 1 where the estimate has a value, evaluated or not; elsewhere there is no error to show.
[[nodiscard]] Image<std::uint8_t> present_mask(const Evaluation& evaluation);

/// |truth − estimate| in px.
[[nodiscard]] Image<float> absolute_error_map(const Evaluation& evaluation);

/// Threshold of the map of bad pixels, px; strictly above is bad [HJKG16].
inline constexpr double kBadPixelThreshold_px = 0.07;

/// The places of good and bad pixels in a colour map from 0 (green) to 1 (red).
inline constexpr float kGoodPixel = 0.2F;
inline constexpr float kBadPixel = 1.0F;

/// kBadPixel where |error| is strictly above `threshold_px` or the estimate is missing, else
/// kGoodPixel.
[[nodiscard]] Image<float> bad_pixel_map(const Evaluation& evaluation, double threshold_px);

}  // namespace episcope
