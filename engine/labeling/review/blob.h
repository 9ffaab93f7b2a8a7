// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/array/image.h"
#include "engine/core/array/indices.h"
#include "engine/core/array/pixel_rect.h"

#include <cstdint>
#include <vector>

namespace episcope {

/// A connected set of pixels of an image.
struct Blob {
  PixelRect bounds;
  Image<std::uint8_t> mask;  ///< `[y][x]` of `bounds`; 1 = belongs to it.
  int pixels = 0;
  PixelIndex inside;  ///< The pixel that lies deepest in it.

  /// Whether a pixel of the image belongs to it.
  [[nodiscard]] bool contains(PixelIndex pixel) const {
    return pixel.y >= bounds.y0 && pixel.y < bounds.y1 && pixel.x >= bounds.x0 &&
           pixel.x < bounds.x1 && mask.at(pixel.y - bounds.y0, pixel.x - bounds.x0) != 0;
  }
};

/// Which pixels count as neighbours: Sides those that share a side, Corners also those that share a
/// corner.
enum class Neighbours { Sides, Corners };

/// The connected sets of the pixels of `mask` that are not 0, those of at least `least_pixels`, in
/// the order of their first pixels, by row, then column.
[[nodiscard]] std::vector<Blob> blobs_of(ImageView<const std::uint8_t> mask, Neighbours neighbours,
                                         int least_pixels = 1);

}  // namespace episcope
