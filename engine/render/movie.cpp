// SPDX-License-Identifier: BSD-3-Clause
#include "engine/render/movie.h"

#include <cmath>
#include <numbers>

namespace episcope::render {
namespace {

using Views = std::vector<ViewIndex>;

// Back through the views in between.
Views with_return(Views views) {
  for (int i = static_cast<int>(views.size()) - 2; i > 0; --i) views.push_back(views[i]);
  return views;
}

Views swing(GridShape grid) {
  Views views;
  const ViewIndex center = grid.center();
  if (grid.u > 1) {
    for (int u = 0; u < grid.u; ++u) views.push_back({center.v, u});
  } else {
    for (int v = 0; v < grid.v; ++v) views.push_back({v, center.u});
  }
  return with_return(std::move(views));
}

Views snake(GridShape grid) {
  Views views;
  for (int v = 0; v < grid.v; ++v) {
    for (int i = 0; i < grid.u; ++i) views.push_back({v, v % 2 == 0 ? i : grid.u - 1 - i});
  }
  return with_return(std::move(views));
}

Views circle(GridShape grid) {
  const double v0 = 0.5 * (grid.v - 1), u0 = 0.5 * (grid.u - 1);
  const int steps = 16 * (grid.v + grid.u);
  Views views;
  for (int i = 0; i < steps; ++i) {
    const double angle = 2 * std::numbers::pi * i / steps;
    const ViewIndex view{static_cast<int>(std::lround(v0 - v0 * std::cos(angle))),
                         static_cast<int>(std::lround(u0 + u0 * std::sin(angle)))};
    if (views.empty() || !(views.back() == view)) views.push_back(view);
  }
  while (views.size() > 1 && views.back() == views.front()) views.pop_back();
  return views;
}

}  // namespace

Views camera_path(GridShape grid, CameraPath path) {
  if (grid.count() <= 0) return {};
  if (path == CameraPath::Snake) return snake(grid);
  const bool is_line = grid.v == 1 || grid.u == 1;
  return path == CameraPath::Swing || is_line ? swing(grid) : circle(grid);
}

std::vector<double> there_and_back(double from, double to, int count) {
  std::vector<double> values(count);
  for (int i = 0; i < count; ++i) {
    const double share = 0.5 - 0.5 * std::cos(2 * std::numbers::pi * i / count);
    values[i] = from + (to - from) * share;
  }
  return values;
}

}  // namespace episcope::render
