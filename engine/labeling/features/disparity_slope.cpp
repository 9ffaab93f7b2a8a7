// SPDX-License-Identifier: BSD-3-Clause
#include "engine/labeling/features/disparity_slope.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace episcope {
namespace {

constexpr int kDistances_px[] = {3, 6};
constexpr float kUnknown = std::numeric_limits<float>::max();

/// Replaces slopes by those between `from` and `to` that are less inclined.
void take_less(const float* from, const float* to, float scale, int count, float* slope) {
  for (int i = 0; i < count; ++i) {
    const float other = scale * (to[i] - from[i]);
    slope[i] = std::abs(other) < std::abs(slope[i]) ? other : slope[i];
  }
}

void end_row(int width, float* slope) {
  std::replace(slope, slope + width, kUnknown, 0.0F);
}

void slopes_along_row(const float* row, int width, float* slope) {
  std::fill_n(slope, width, kUnknown);
  for (const int distance : kDistances_px) {
    const float scale = 1.0F / static_cast<float>(distance);
    const int count = width - distance;
    if (count <= 0) continue;
    take_less(row, row + distance, scale, count, slope);
    take_less(row, row + distance, scale, count, slope + distance);
  }
  end_row(width, slope);
}

void slopes_down(ImageView<const float> map, int y, float* slope) {
  std::fill_n(slope, map.width, kUnknown);
  for (const int distance : kDistances_px) {
    const float scale = 1.0F / static_cast<float>(distance);
    if (y + distance < map.height) {
      take_less(map.row(y), map.row(y + distance), scale, map.width, slope);
    }
    if (y >= distance) take_less(map.row(y - distance), map.row(y), scale, map.width, slope);
  }
  end_row(map.width, slope);
}

}  // namespace

DisparitySlopes disparity_slopes(ImageView<const float> disparity) {
  DisparitySlopes slopes{Image<float>(disparity.height, disparity.width),
                         Image<float>(disparity.height, disparity.width)};
  for (int y = 0; y < disparity.height; ++y) {
    slopes_along_row(disparity.row(y), disparity.width, slopes.x.row(y));
    slopes_down(disparity, y, slopes.y.row(y));
  }
  return slopes;
}

}  // namespace episcope
