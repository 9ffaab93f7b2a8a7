// SPDX-License-Identifier: BSD-3-Clause
#include "engine/labeling/ray_targets.h"

#include "engine/core/parallel.h"
#include "engine/labeling/ray_kernel.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace episcope {
namespace {

// A row of fewer rays than the widest vector has lanes, with rays beside it that arrive nowhere.
void find_few_targets(const RayKernel& kernel, RayRow rays, std::int32_t* targets) {
  float disparity[kRayColumns];
  std::uint8_t valid[kRayColumns] = {};
  std::int32_t found[kRayColumns];
  std::fill_n(disparity, kRayColumns, std::numeric_limits<float>::quiet_NaN());
  std::copy_n(rays.disparity, rays.end, disparity);
  if (rays.valid != nullptr) {
    std::copy_n(rays.valid, rays.end, valid);
    rays.valid = valid;
  }
  const int count = rays.end;
  rays.disparity = disparity;
  rays.end = kRayColumns;
  kernel.find_targets(rays, found);
  std::copy_n(found, count, targets);
}

}  // namespace

void find_ray_targets(const DisparityView& from, const DisparityView& to, ViewIndex step, int y,
                      std::int32_t* targets) {
  find_ray_targets(from, to, step, y, {0, from.disparity.width}, targets);
}

void find_ray_targets(const DisparityView& from, const DisparityView& to, ViewIndex step, int y,
                      ColumnRange columns, std::int32_t* targets) {
  static const RayKernel& kernel = EPISCOPE_CHOOSE_KERNEL(best_isa(), kRayKernel);
  RayRow rays;
  rays.height = from.disparity.height;
  rays.width = from.disparity.width;
  rays.begin = columns.begin;
  rays.end = columns.end;
  rays.row = static_cast<float>(y);
  rays.step_x = static_cast<float>(step.u);
  rays.step_y = static_cast<float>(step.v);
  rays.disparity = from.disparity.row(y);
  rays.valid = from.valid.empty() ? nullptr : from.valid.row(y);
  rays.there = to.disparity.data;
  rays.valid_there = to.valid.empty() ? nullptr : to.valid.data;
  rays.tolerance = kSamePointTolerance_px;
  if (rays.width < kRayColumns) return find_few_targets(kernel, rays, targets);
  kernel.find_targets(rays, targets);
}

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
