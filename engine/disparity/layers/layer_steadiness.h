// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/array/image.h"
#include "engine/core/parallel/progress.h"

#include <cstdint>

namespace episcope {

/// How far two layers are surfaces, in [0, 1]. Two orientations that are read into noise, or into
/// silhouettes, leap from pixel to pixel; those of a transparent surface and of what is behind it
/// do not. With s² the variance of disparity over the 5×5 px around a pixel, weighted by
/// confidence, of the layer that varies more, and s₀ = 0.2 px: the mean of 1/(1 + s²/s₀²) over 9×9
/// px, of which 0.3 is no surface and 0.5 is one. All images are `[y][x]` of one size; `confidence`
/// in 1/255. Throws Cancelled. Evidence: tests/accuracy/tuning.md.
[[nodiscard]] Image<float> layer_steadiness(ImageView<const float> near, ImageView<const float> far,
                                            ImageView<const std::uint8_t> confidence,
                                            const Progress& progress);

}  // namespace episcope
