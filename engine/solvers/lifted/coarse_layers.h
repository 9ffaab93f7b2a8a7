// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/array/image.h"
#include "engine/core/array/volume.h"
#include "engine/core/parallel/progress.h"
#include "engine/solvers/lifted/layered_sweep.h"

#include <cstdint>

namespace episcope {

/// Means of blocks of 2×2 pixels (fewer at the right and lower border), `[y][layer][x]`. `to` has
/// half the size of `from`, rounded up.
void halve(VolumeView<const float> from, const Progress& progress, VolumeView<float> to);
[[nodiscard]] Image<float> halved(ImageView<const float> from);

/// Initialises `fine` with the result of `coarse`, of half the size: φ is repeated, duals are
/// distributed over the two pairs of pixels that replace one, and interpolated in between. Costs of
/// both are per pixel, so duals and smoothness of the finer level are twice those of the coarser
/// one.
void begin_from(LayeredSweep& coarse, const Progress& progress, LayeredSweep& fine);

/// Initialises `to` with the result of `from`, of the same size, for an image whose pixels have
/// moved: each pixel takes φ and the duals of the pixel y'·width + x' given in `places` `[y][x]`,
/// or of the one at its own place where that is −1. On layers that do not take part both are 0.
void begin_from_moved(LayeredSweep& from, ImageView<const std::int32_t> places,
                      const RacingLayers& racing, const Progress& progress, LayeredSweep& to);

}  // namespace episcope
