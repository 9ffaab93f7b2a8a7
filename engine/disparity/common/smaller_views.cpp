// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/common/smaller_views.h"

#include "engine/core/parallel/parallel.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

namespace episcope {
namespace {

// Means of blocks of one view.
void reduce(const LightField& lf, ViewIndex view, int factor, ImageView<std::uint16_t> out) {
  const int channels = lf.channels(), width = out.width * factor;
  const float scale = 65535.0F / static_cast<float>(factor * factor);
  std::vector<float> row(static_cast<std::size_t>(width) * channels);
  std::vector<float> sums(static_cast<std::size_t>(out.width) * channels);
  for (int y = 0; y < out.height; ++y) {
    std::ranges::fill(sums, 0.0F);
    for (int dy = 0; dy < factor; ++dy) {
      lf.read_row(view, y * factor + dy, 0, width, row.data());
      for (int x = 0; x < width; ++x) {
        float* const sum = sums.data() + static_cast<std::size_t>(x / factor) * channels;
        for (int c = 0; c < channels; ++c)
          sum[c] += row[static_cast<std::size_t>(x) * channels + c];
      }
    }
    std::uint16_t* const to = out.row(y);
    for (std::size_t i = 0; i < sums.size(); ++i) {
      const float clamped = std::clamp(sums[i] * scale, 0.0F, 65535.0F);
      to[i] = static_cast<std::uint16_t>(clamped + 0.5F);
    }
  }
}

void reduce_valid(const LightField& lf, ViewIndex view, int factor, ImageView<std::uint8_t> out) {
  for (int y = 0; y < out.height; ++y) {
    for (int x = 0; x < out.width; ++x) {
      bool is_valid = true;
      for (int i = 0; i < factor * factor; ++i) {
        is_valid = is_valid && lf.is_valid(view, y * factor + i / factor, x * factor + i % factor);
      }
      out.at(y, x) = is_valid ? 1 : 0;
    }
  }
}

}  // namespace

LightField smaller_views(const LightField& lf, int factor, const Progress& progress,
                         ReducedViews reduced) {
  const GridShape grid = lf.grid();
  const int height = lf.height() / factor, width = lf.width() / factor;
  ViewStack<std::uint16_t> samples(grid, height, width, lf.channels(), {}, allocate_large_zeros);
  ViewStack<std::uint8_t> valid;
  if (!lf.valid().empty()) valid = ViewStack<std::uint8_t>(grid, height, width);
  parallel_for(grid.count(), progress, [&](int i) {
    const ViewIndex view = samples.view_at(i), center = lf.center();
    if (reduced == ReducedViews::All || view.v == center.v || view.u == center.u) {
      reduce(lf, view, factor, samples.view(view));
    }
    if (!valid.empty()) reduce_valid(lf, view, factor, valid.view(view));
    lf.forget_samples();
  });
  return {std::move(samples), LightFieldInfo(), std::move(valid)};
}

}  // namespace episcope
