// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/beside/map_scale.h"

#include "engine/io/order/warp_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace episcope::io {
namespace {

/// A map that explains views this well needs no comparison with other units.
constexpr double kPlain = 0.5;
/// Another unit must leave at most this share of the error.
constexpr double kClearlyBetter = 0.85;

struct ScaledMap {
  Image<float> disparity;
  ImageView<const std::uint8_t> valid;
  [[nodiscard]] DisparityView view() const { return {disparity.view(), valid}; }
};

ScaledMap scaled(const DisparityView& map, double factor) {
  ScaledMap result{Image<float>(map.disparity.height, map.disparity.width), map.valid};
  for (int y = 0; y < map.disparity.height; ++y) {
    const float* in = map.disparity.row(y);
    std::transform(in, in + map.disparity.width, result.disparity.row(y),
                   [&](float value) { return static_cast<float>(factor * value); });
  }
  return result;
}

/// The view and its four neighbours with rows and columns exchanged; the corners stay unset.
LightField::Samples transposed_cross(const LightField::Samples& samples, ViewIndex at) {
  return std::visit(
      [&]<class T>(const ViewStack<T>& stack) -> LightField::Samples {
        ViewStack<T> cross({3, 3}, stack.height(), stack.width(), stack.channels());
        for (int v = -1; v <= 1; ++v) {
          for (int u = -1; u <= 1; ++u) {
            if (v != 0 && u != 0) continue;
            std::copy_n(stack.view({at.v + v, at.u + u}).data, stack.view_size(),
                        cross.view({1 + u, 1 + v}).data);
          }
        }
        return cross;
      },
      samples);
}

bool has_four_neighbours(GridShape grid, ViewIndex at) {
  return at.v > 0 && at.u > 0 && at.v + 1 < grid.v && at.u + 1 < grid.u;
}

Explanation explanation_of(const WarpErrors& errors) {
  Explanation found;
  const auto pixels = static_cast<double>(errors.u.pixels + errors.v.pixels);
  if (pixels == 0) return found;
  found.error = errors.best();
  found.unwarped = (errors.u.unwarped * static_cast<double>(errors.u.pixels) +
                    errors.v.unwarped * static_cast<double>(errors.v.pixels)) /
                   pixels;
  found.reversed_u = errors.u.says_reversed();
  found.reversed_v = errors.v.says_reversed();
  return found;
}

}  // namespace

std::vector<MapUnit> common_units(GridShape grid, int width) {
  std::vector<MapUnit> units{{1, "px per view step"}};
  const int steps = std::max(grid.u, grid.v) - 1;
  if (steps > 1) {
    units.push_back(
        {1.0 / steps, fmt::format("px over the {} steps of the whole baseline", steps)});
  }
  if (steps > 3) {
    units.push_back({2.0 / steps, "px from the centre view to the outermost one"});
  }
  units.push_back({static_cast<double>(width), "widths of the image per view step"});
  return units;
}

Explanation explain_views(const LightField::Samples& samples, ViewIndex at,
                          const DisparityView& map, double factor) {
  const ScaledMap disparity = scaled(map, factor);
  Explanation best = explanation_of(warp_errors(samples, at, disparity.view()));
  const GridShape grid = grid_of(samples);
  if (best.error <= kPlain * best.unwarped || !has_four_neighbours(grid, at)) return best;
  Explanation exchanged =
      explanation_of(warp_errors(transposed_cross(samples, at), {1, 1}, disparity.view()));
  if (exchanged.error >= kClearlyBetter * best.error) return best;
  exchanged.is_transposed = true;
  return exchanged;
}

SettledUnit settle_unit(const LightField::Samples& samples, ViewIndex at, const DisparityView& map,
                        const std::vector<MapUnit>& units) {
  const Explanation first = explain_views(samples, at, map, units.front().factor);
  SettledUnit best{units.front(), first, first};
  if (first.error <= kPlain * first.unwarped) return best;
  for (std::size_t i = 1; i < units.size(); ++i) {
    const Explanation other = explain_views(samples, at, map, units[i].factor);
    const bool is_better = other.error < kClearlyBetter * first.error && other.is_good() &&
                           other.error < best.explanation.error;
    if (is_better) best = {units[i], other, first};
  }
  return best;
}

}  // namespace episcope::io
