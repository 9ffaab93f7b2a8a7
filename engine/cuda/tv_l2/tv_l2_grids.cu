// SPDX-License-Identifier: BSD-3-Clause
#include "engine/core/array/round_up.h"
#include "engine/cuda/tv_l2/tv_l2_grids.cuh"

#include <algorithm>

namespace episcope::cuda {
namespace {

// Before the first pixel of a plane, besides a row, and behind the last.
constexpr long kMargin = 32;

long plane_size(const TvL2Level& level, int views) {
  return views * level.view + 2 * kMargin;
}

// Level by level down to a single pixel, at least two.
TvL2Levels make_levels(int height, int width) {
  TvL2Levels levels;
  for (;;) {
    TvL2Level& level = levels.level[levels.count++];
    level.height = height;
    level.width = width;
    const int unit = level.half() >= 64 ? 32 : 4;
    level.odd = round_up(level.half() + 1, unit);
    level.pitch = 2 * level.odd;
    level.view = (height + 2) * level.pitch;
    if (std::max(height, width) == 1 && levels.count >= 2) return levels;
    height = (height + 1) / 2;
    width = (width + 1) / 2;
  }
}

std::size_t floats_of(const TvL2Levels& levels, int views) {
  long floats = 0;
  for (int k = 0; k < levels.count; ++k) floats += kTvL2Slots * plane_size(levels.level[k], views);
  return static_cast<std::size_t>(floats);
}

}  // namespace

TvL2Grids::TvL2Grids(int height, int width, int views, const DeviceStream& stream)
    : view_count_(views),
      levels_(make_levels(height, width)),
      memory_(floats_of(levels_, views), stream),
      views_(static_cast<std::size_t>(views), stream) {
  memory_.clear();
  float* next = memory_.data();
  for (int k = 0; k < levels_.count; ++k) {
    TvL2Level& level = levels_.level[k];
    for (float*& plane : level.planes) {
      plane = next + kMargin + level.pitch;
      next += plane_size(level, views);
    }
  }
}

std::size_t TvL2Grids::bytes_per_view(int height, int width) {
  return floats_of(make_levels(height, width), 1) * sizeof(float);
}

void TvL2Grids::set_views(const std::vector<TvL2View>& views, const DeviceStream& stream) {
  check(cudaMemcpyAsync(views_.data(), views.data(), views.size() * sizeof(TvL2View),
                        cudaMemcpyHostToDevice, stream.get()));
}

}  // namespace episcope::cuda
