// SPDX-License-Identifier: BSD-3-Clause
#include "app/session/scene_range.h"

#include <algorithm>
#include <limits>

namespace episcope {

Interval extent(const DisparityView& view) {
  Interval range{std::numeric_limits<double>::max(), std::numeric_limits<double>::lowest()};
  for (int y = 0; y < view.disparity.height; ++y) {
    for (int x = 0; x < view.disparity.width; ++x) {
      if (!view.is_valid(y, x)) continue;
      const double value = view.disparity.at(y, x);
      range = {std::min(range.min, value), std::max(range.max, value)};
    }
  }
  return range.min <= range.max ? range : Interval{};
}

Interval known_disparity_range(const Scene& scene) {
  const DisparityField& truth = scene.truth->field;
  if (!truth.empty()) {
    const ViewIndex center = scene.light_field->center();
    const Interval range =
        extent(truth.view(truth.contains(center) ? center : truth.disparity.first()));
    if (range.length() > 0) return range;
  }
  return scene.light_field->info().disparity_range.value_or(Interval{});
}

}  // namespace episcope
