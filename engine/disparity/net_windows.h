// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/image.h"
#include "engine/core/progress.h"
#include "engine/disparity/kernels/net_constants.h"

#include <array>

namespace episcope {

/// The largest number (or the smallest) of the size × size pixels around each, of those that exist.
[[nodiscard]] Image<float> window_most(const Image<float>& map, int size, const Progress& progress);
[[nodiscard]] Image<float> window_least(const Image<float>& map, int size,
                                        const Progress& progress);

/// The median of 5 × 5 pixels, `apart` px from one to the next, around each. The border is
/// repeated. All numbers must be finite.
[[nodiscard]] Image<float> window_median(const Image<float>& map, int apart,
                                         const Progress& progress);

/// Disparities among which `net` chooses: a map, its maxima, minima and medians around each pixel,
/// a second map.
[[nodiscard]] std::array<Image<float>, kNetHypotheses> net_hypotheses(const Image<float>& map,
                                                                      const Image<float>& second,
                                                                      const Progress& progress);

}  // namespace episcope
