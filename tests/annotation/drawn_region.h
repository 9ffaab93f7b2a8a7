// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "annotation/scribble_layer.h"
#include "engine/core/image.h"

namespace episcope::test {

/// How often a region covers each pixel.
inline Image<std::uint8_t> drawn(const PixelRegion& region, int height, int width) {
  Image<std::uint8_t> picture(height, width);
  for (const PixelSpan& span : region) {
    for (int x = span.x0; x < span.x1; ++x) ++picture.at(span.y, x);
  }
  return picture;
}

}  // namespace episcope::test
