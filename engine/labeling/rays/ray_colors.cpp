// SPDX-License-Identifier: BSD-3-Clause
#include "engine/labeling/rays/ray_colors.h"

#include "engine/core/parallel/parallel.h"
#include "engine/labeling/rays/ray_kernel.h"

#include <algorithm>
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

void RayColors::trusts(const Pair& pair, ColumnRange columns, const std::int32_t* targets,
                       float* trusts) const {
  if (colors_ != nullptr && colors_->channels() == 3) {
    static const RayKernel& kernel = EPISCOPE_CHOOSE_KERNEL(best_isa(), kRayKernel);
    RayTrusts rays;
    rays.begin = columns.begin;
    rays.end = columns.end;
    rays.width = colors_->width();
    rays.row = pair.row;
    rays.other = pair.other;
    rays.last = colors_->height() * colors_->width() - 1;
    rays.targets = targets;
    rays.table = table_.data();
    rays.most = kNoTrust;
    return kernel.find_trusts(rays, trusts);
  }
  for (int x = columns.begin; x < columns.end; ++x) {
    trusts[x] = targets[x] < 0 ? 0.0F : trust(pair, x, targets[x]);
  }
}

float RayColors::trust(const Pair& pair, int x, std::int32_t target) const {
  if (pair.row == nullptr) return 1;
  const std::ptrdiff_t channels = colors_->channels();
  int sum = 0;
  for (std::ptrdiff_t c = 0; c < channels; ++c) {
    const int difference = pair.row[x * channels + c] - pair.other[target * channels + c];
    sum += difference * difference;
  }
  if (channels == 1) sum *= 3;
  return table_[std::min(sum, kNoTrust)];
}

}  // namespace episcope
