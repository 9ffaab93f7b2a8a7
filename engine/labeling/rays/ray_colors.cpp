// SPDX-License-Identifier: BSD-3-Clause
#include "engine/labeling/rays/ray_colors.h"

#include "engine/core/parallel/parallel.h"

#include <cmath>
#include <vector>

namespace episcope {
namespace {

constexpr float kSigma = 10;  // of 255

void store_view(const LightField& lf, ViewIndex view, ImageView<std::uint8_t> colors) {
  std::vector<float> row(static_cast<std::size_t>(colors.width) * colors.channels);
  for (int y = 0; y < colors.height; ++y) {
    lf.read_row(view, y, 0, colors.width, row.data());
    std::transform(row.begin(), row.end(), colors.row(y), [](float sample) {
      return static_cast<std::uint8_t>(std::clamp(sample, 0.0F, 1.0F) * 255 + 0.5F);
    });
  }
}

std::unique_ptr<const ViewStack<std::uint8_t>> rounded_views(const LightField& lf, GridShape grid,
                                                             ViewIndex first,
                                                             const Progress& progress) {
  auto colors = std::make_unique<ViewStack<std::uint8_t>>(grid, lf.height(), lf.width(),
                                                          lf.channels(), first);
  parallel_for(grid.count(), progress, [&](int i) {
    const ViewIndex view = grid.view_at(i, first);
    store_view(lf, view, colors->view(view));
  });
  return colors;
}

}  // namespace

RayColors::RayColors(const LightField& light_field, GridShape grid, ViewIndex first,
                     const Progress& progress)
    : colors_(std::get_if<ViewStack<std::uint8_t>>(&light_field.samples())) {
  for (int s = 0; s < kNoTrust; ++s) {
    table_[s] = std::exp(-static_cast<float>(s) / (2 * kSigma * kSigma));
  }
  table_[kNoTrust] = 0;
  if (colors_ != nullptr) return;
  rounded_ = rounded_views(light_field, grid, first, progress);
  colors_ = rounded_.get();
}

}  // namespace episcope
