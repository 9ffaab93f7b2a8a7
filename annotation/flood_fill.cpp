// SPDX-License-Identifier: BSD-3-Clause
#include "annotation/flood_fill.h"

#include "engine/core/error.h"

#include <algorithm>
#include <string>

namespace episcope {
namespace {

/// Spans of the connected pixels for which `is_open(y, x)`.
template <class IsOpen>
PixelRegion connected_region(int height, int width, PixelIndex seed, const IsOpen& is_open) {
  PixelRegion region;
  if (seed.y < 0 || seed.y >= height || seed.x < 0 || seed.x >= width) return region;
  Image<std::uint8_t> visited(height, width);
  const auto is_new = [&](int y, int x) { return visited.at(y, x) == 0 && is_open(y, x); };
  std::vector<PixelIndex> open;
  if (is_new(seed.y, seed.x)) open.push_back(seed);
  while (!open.empty()) {
    const PixelIndex pixel = open.back();
    open.pop_back();
    if (visited.at(pixel.y, pixel.x) != 0) continue;
    PixelSpan span{pixel.y, pixel.x, pixel.x + 1};
    while (span.x0 > 0 && is_new(span.y, span.x0 - 1)) --span.x0;
    while (span.x1 < width && is_new(span.y, span.x1)) ++span.x1;
    std::fill(visited.row(span.y) + span.x0, visited.row(span.y) + span.x1, std::uint8_t{1});
    region.push_back(span);
    for (const int y : {span.y - 1, span.y + 1}) {
      if (y < 0 || y >= height) continue;
      for (int x = span.x0; x < span.x1; ++x) {
        // The first of each stretch is enough: its span covers the rest.
        if (is_new(y, x) && (x == span.x0 || !is_new(y, x - 1))) open.push_back({y, x});
      }
    }
  }
  return region;
}

/// Squared norm of the colour gradient; one-sided at the border.
float gradient2(ImageView<const float> picture, int y, int x) {
  const int left = std::max(x - 1, 0);
  const int right = std::min(x + 1, picture.width - 1);
  const int up = std::max(y - 1, 0);
  const int down = std::min(y + 1, picture.height - 1);
  const float along_x = right > left ? 1.0F / static_cast<float>(right - left) : 0.0F;
  const float along_y = down > up ? 1.0F / static_cast<float>(down - up) : 0.0F;
  float sum = 0;
  for (int c = 0; c < picture.channels; ++c) {
    const float dx = (picture.at(y, right, c) - picture.at(y, left, c)) * along_x;
    const float dy = (picture.at(down, x, c) - picture.at(up, x, c)) * along_y;
    sum += dx * dx + dy * dy;
  }
  return sum;
}

}  // namespace

PixelRegion region_within_edges(ImageView<const float> picture, PixelIndex seed,
                                double max_gradient) {
  if (!(max_gradient >= 0)) {
    throw InvalidInput("a fill cannot stop at a gradient of " + std::to_string(max_gradient) +
                       "; choose 0 or more");
  }
  const auto limit = static_cast<float>(max_gradient * max_gradient);
  return connected_region(picture.height, picture.width, seed,
                          [&](int y, int x) { return gradient2(picture, y, x) < limit; });
}

PixelRegion region_of_segment(ImageView<const std::int32_t> segmentation, PixelIndex seed) {
  const bool is_inside =
      seed.y >= 0 && seed.y < segmentation.height && seed.x >= 0 && seed.x < segmentation.width;
  if (!is_inside) return {};
  const std::int32_t label = segmentation.at(seed.y, seed.x);
  return connected_region(segmentation.height, segmentation.width, seed,
                          [&](int y, int x) { return segmentation.at(y, x) == label; });
}

}  // namespace episcope
