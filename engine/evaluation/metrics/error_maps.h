// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/evaluation/metrics/metrics.h"

namespace episcope {

/// Pictures of an evaluation, from the very errors that its numbers were computed from. Maps
/// of errors are shown with `shown_mask`, that of bad pixels with `evaluation.judged`.

/// 1 where a picture of the error has something to show: judged and not missing.
[[nodiscard]] Image<std::uint8_t> shown_mask(const Evaluation& evaluation);

/// |truth − estimate| in px.
[[nodiscard]] Image<float> absolute_error_map(const Evaluation& evaluation);

/// 1.0 where |error| is strictly above `threshold_px` or the estimate is missing, else 0.2: the
/// places of bad and good in the colour map of bad pixels.
[[nodiscard]] Image<float> bad_pixel_map(const Evaluation& evaluation, double threshold_px);

}  // namespace episcope
