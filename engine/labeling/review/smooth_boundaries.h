// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/array/image.h"

#include <cstdint>

namespace episcope {

/// Labels whose boundaries are smoother: each pixel takes the label with the most pixels around it,
/// weighted by a Gaussian of standard deviation `smoothing_px`; of equals it keeps its own.
/// Straight boundaries stay where they are, corners are rounded, and what is much thinner than
/// `smoothing_px` vanishes. Painted pixels keep their labels. 0 px gives the labels as they are.
///
/// `labels` `[y][x]`; `painted` `[y][x]` (0 = not painted) or empty. Source: one step of Merriman,
/// Bence and Osher, Diffusion generated motion by mean curvature, 1992, with several labels. Throws
/// InvalidInput for a negative smoothing or if sizes differ.
[[nodiscard]] Image<std::int32_t> smooth_boundaries(ImageView<const std::int32_t> labels,
                                                    ImageView<const std::uint8_t> painted,
                                                    double smoothing_px);

}  // namespace episcope
