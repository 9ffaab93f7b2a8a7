// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/browse/thumbnails.h"

#include "engine/render/shade.h"

#include <algorithm>

namespace episcope {
namespace {

constexpr int kRgba = 4;

// Mean of the pixels of `source` that fall into each pixel of the result.
Image<std::uint8_t> shrink(const Image<std::uint8_t>& source, int factor) {
  const int height = std::max(1, source.height() / factor);
  const int width = std::max(1, source.width() / factor);
  Image<std::uint8_t> result(height, width, kRgba);
  const int rows = std::min(factor, source.height());
  const int columns = std::min(factor, source.width());
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      int sums[kRgba] = {};
      for (int dy = 0; dy < rows; ++dy) {
        const std::uint8_t* pixel = &source.at(y * rows + dy, x * columns);
        for (int i = 0; i < columns * kRgba; ++i) sums[i % kRgba] += pixel[i];
      }
      for (int c = 0; c < kRgba; ++c) {
        result.at(y, x, c) = static_cast<std::uint8_t>(sums[c] / (rows * columns));
      }
    }
  }
  return result;
}

}  // namespace

std::vector<Image<std::uint8_t>> make_thumbnails(const LightField& light_field, int width,
                                                 int height, const render::ToneTable* tone,
                                                 const Progress& progress) {
  const auto times_larger = [](int full, int small) {
    return (full + small - 1) / std::max(1, small);
  };
  const int factor = std::max(
      {1, times_larger(light_field.width(), width), times_larger(light_field.height(), height)});
  std::vector<Image<std::uint8_t>> pictures;
  const GridShape grid = light_field.grid();
  for (int v = 0; v < grid.v; ++v) {
    for (int u = 0; u < grid.u; ++u) {
      progress.check();
      pictures.push_back(shrink(render::shade_view(light_field, {v, u}, tone), factor));
    }
  }
  return pictures;
}

}  // namespace episcope
