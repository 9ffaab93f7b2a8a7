// SPDX-License-Identifier: BSD-3-Clause
#include "widgets/browse/play_path.h"

#include <cmath>
#include <numbers>

namespace episcope {
namespace {

std::vector<ViewIndex> circle(GridShape grid) {
  const double radius_v = (grid.v - 1) / 2.0;
  const double radius_u = (grid.u - 1) / 2.0;
  const int samples = 16 * (grid.v + grid.u);
  std::vector<ViewIndex> views;
  for (int i = 0; i < samples; ++i) {
    const double angle = 2 * std::numbers::pi * i / samples;
    const ViewIndex view{static_cast<int>(std::lround(radius_v * (1 - std::cos(angle)))),
                         static_cast<int>(std::lround(radius_u * (1 + std::sin(angle))))};
    if (views.empty() || !(views.back() == view)) views.push_back(view);
  }
  if (views.size() > 1 && views.back() == views.front()) views.pop_back();
  return views;
}

std::vector<ViewIndex> snake(GridShape grid) {
  std::vector<ViewIndex> views;
  for (int v = 0; v < grid.v; ++v) {
    for (int i = 0; i < grid.u; ++i) views.push_back({v, v % 2 == 0 ? i : grid.u - 1 - i});
  }
  for (int i = static_cast<int>(views.size()) - 2; i > 0; --i) views.push_back(views[i]);
  return views;
}

}  // namespace

std::vector<ViewIndex> play_path(GridShape grid, PlayPath path) {
  if (grid.count() <= 0) return {};
  return path == PlayPath::Circle ? circle(grid) : snake(grid);
}

}  // namespace episcope
