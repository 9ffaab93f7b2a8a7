// SPDX-License-Identifier: BSD-3-Clause
#include "engine/render/region_statistics.h"

#include "engine/core/numbers.h"

#include <algorithm>
#include <cmath>

namespace episcope::render {
namespace {

constexpr double kAxisQuantile = 0.002;
constexpr double kRobustQuantile = 0.01;
constexpr double kAxisRoom = 0.03;  // part of the axis that stays free on each side

PixelRect clipped(const PixelRect& region, int height, int width) {
  return {std::max(0, region.y0), std::max(0, region.x0), std::min(height, region.y1),
          std::min(width, region.x1)};
}

std::vector<float> values_in(const MeasuredMap& map, const PixelRect& region,
                             std::size_t& invalid) {
  std::vector<float> values;
  const int rows = std::max(0, region.y1 - region.y0);
  const int columns = std::max(0, region.x1 - region.x0);
  values.reserve(static_cast<std::size_t>(rows) * static_cast<std::size_t>(columns));
  for (int y = region.y0; y < region.y1; ++y) {
    const float* row = map.values.row(y);
    const std::uint8_t* valid = map.valid.empty() ? nullptr : map.valid.row(y);
    const std::uint8_t* inside = map.inside.empty() ? nullptr : map.inside.row(y);
    for (int x = region.x0; x < region.x1; ++x) {
      if (inside && inside[x] == 0) continue;
      if ((valid && valid[x] == 0) || !std::isfinite(row[x])) {
        ++invalid;
      } else {
        values.push_back(row[x]);
      }
    }
  }
  return values;
}

Histogram histogram_of(const std::vector<float>& values, Interval axis, int bars) {
  if (axis.length() <= 0) axis = {axis.min - 0.5, axis.min + 0.5};
  const double room = kAxisRoom * axis.length();
  Histogram histogram{{axis.min - room, axis.max + room},
                      std::vector<std::uint32_t>(static_cast<std::size_t>(bars))};
  const double scale = bars / histogram.axis.length();
  for (const float value : values) {
    const double place = std::floor((value - histogram.axis.min) * scale);
    if (place >= 0 && place < bars) ++histogram.counts[static_cast<std::size_t>(place)];
  }
  return histogram;
}

}  // namespace

RegionStatistics region_statistics(const MeasuredMap& map, PixelRect region, Interval shown,
                                   int bars) {
  region = clipped(region, map.values.height, map.values.width);
  RegionStatistics statistics;
  std::vector<float> values = values_in(map, region, statistics.invalid);
  statistics.count = values.size();
  if (values.empty()) return statistics;
  double sum = 0;
  for (const float value : values) sum += value;
  statistics.mean = sum / static_cast<double>(values.size());
  const auto [least, greatest] = std::minmax_element(values.begin(), values.end());
  statistics.min = *least;
  statistics.max = *greatest;
  statistics.median = quantile(values, 0.5);
  statistics.robust = {quantile(values, kRobustQuantile), quantile(values, 1 - kRobustQuantile)};
  Interval axis{quantile(values, kAxisQuantile), quantile(values, 1 - kAxisQuantile)};
  if (shown.length() > 0) {
    axis = {std::min(axis.min, shown.min), std::max(axis.max, shown.max)};
  }
  statistics.histogram = histogram_of(values, axis, bars);
  return statistics;
}

}  // namespace episcope::render
