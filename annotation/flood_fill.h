// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "annotation/scribble_layer.h"
#include "engine/core/image.h"
#include "engine/core/indices.h"

#include <cstdint>

namespace episcope {

/// Pixels connected to `seed` by steps to the left, right, up and down over pixels whose color
/// changes slowly: central differences along x and y, combined over the channels (Euclidean norm),
/// stay below `max_gradient`, in units of color per px. Edges thus form a band that is not
/// crossed, as wide as the blur of the picture plus 1 px on each side. `picture` is `[y][x][c]`.
/// Empty if the seed itself lies on an edge or outside. Throws InvalidInput for a negative
/// gradient.
[[nodiscard]] PixelRegion region_within_edges(ImageView<const float> picture, PixelIndex seed,
                                              double max_gradient);

/// Pixels connected to `seed` in the same way that have its label in a segmentation `[y][x]`. Empty
/// if the seed lies outside.
[[nodiscard]] PixelRegion region_of_segment(ImageView<const std::int32_t> segmentation,
                                            PixelIndex seed);

}  // namespace episcope
