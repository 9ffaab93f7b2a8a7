// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/arrays/array_parallax.h"

#include "engine/io/arrays/array_preview.h"

#include <algorithm>
#include <vector>

namespace episcope::io {
namespace {

constexpr int kWindow = 256;

double gone(const AxisEvidence& evidence) {
  return std::max(evidence.gone_along_x(), evidence.gone_along_y());
}

}  // namespace

Parallax measure_parallax(const ArrayInput& array, const ArrayLayout& layout) {
  const GridShape grid = layout.grid();
  const ViewIndex center = grid.center();
  std::vector<ViewIndex> views{center};
  if (grid.u > 1) views.push_back({center.v, center.u - 1});
  if (grid.v > 1) views.push_back({center.v - 1, center.u});
  const std::vector<Image<float>> windows = array_windows(array, layout, views, kWindow);
  const MotionPictures middle(windows.front());
  Parallax parallax;
  for (std::size_t i = 1; i < views.size(); ++i) {
    AxisEvidence& axis = views[i].u == center.u ? parallax.along_v : parallax.along_u;
    axis.add(MotionPictures(windows[i]), middle);
  }
  return parallax;
}

bool are_rather_channels(const AxisEvidence& of_channels, const AxisEvidence& of_views) {
  constexpr double kClearlyLess = 0.5;
  return of_views.is_decided() && !of_channels.is_decided() &&
         gone(of_channels) < kClearlyLess * gone(of_views);
}

}  // namespace episcope::io
