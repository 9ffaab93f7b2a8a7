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

/// Begins `fine` where `coarse`, of half the size, has arrived: φ is repeated, duals are spread
/// over the two pairs of pixels that lie where one lay, and interpolated in between. Costs of both
/// are per pixel, so duals and smoothness of the finer one are twice those of the coarser one.
void begin_from(LayeredSweep& coarse, const Progress& progress, LayeredSweep& fine);

/// Begins `to` where `from`, of the same size, has arrived, for an image whose pixels have moved:
/// each pixel takes over φ and the duals of the pixel y'·width + x' named in `places` `[y][x]`, of
/// the one at its own place where that is −1.
void begin_from_moved(LayeredSweep& from, ImageView<const std::int32_t> places,
                      const Progress& progress, LayeredSweep& to);

}  // namespace episcope
