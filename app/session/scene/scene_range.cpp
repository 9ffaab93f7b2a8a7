// SPDX-License-Identifier: BSD-3-Clause
#include "app/session/scene/scene_range.h"

#include "engine/render/shade.h"

#include <algorithm>
#include <limits>

namespace episcope {

namespace {

// Of no pixel at all.
constexpr Interval kNothing{std::numeric_limits<double>::max(),
                            std::numeric_limits<double>::lowest()};

Interval widened(Interval range, const DisparityView& view) {
  for (int y = 0; y < view.disparity.height; ++y) {
    for (int x = 0; x < view.disparity.width; ++x) {
      if (!view.is_valid(y, x)) continue;
      const double value = view.disparity.at(y, x);
      range = {std::min(range.min, value), std::max(range.max, value)};
    }
  }
  return range;
}

Interval or_none(Interval range) {
  return range.min <= range.max ? range : Interval{};
}

}  // namespace

Interval extent(const DisparityView& view) {
  return or_none(widened(kNothing, view));
}

Interval known_disparity_range(const Scene& scene) {
  const GroundTruth& truth = *scene.truth;
  const ViewIndex center = scene.light_field->center();
  Interval range = kNothing;
  for (const DisparityField* field : {&truth.field, &truth.foreground, &truth.background}) {
    if (field->empty()) continue;
    range =
        widened(range, field->view(field->contains(center) ? center : field->disparity.first()));
  }
  // A point that moves farther than the image from view to view is a mark for "nothing".
  if (range.length() > 0 && range.length() < scene.light_field->width()) return range;
  return scene.light_field->info().disparity_range.value_or(Interval{});
}

Interval display_range(const Estimate& estimate) {
  const DisparityField& field = estimate.field;
  const ViewIndex first = field.disparity.first();
  const ViewIndex middle = field.disparity.grid().center();
  const DisparityView view = field.view({first.v + middle.v, first.u + middle.u});
  return render::robust_range(view.disparity, view.valid);
}

Interval shown_range(Interval known, Interval of_estimate) {
  if (known.length() > 0) return known;
  return of_estimate.length() > 0 ? of_estimate : Interval{-1, 1};
}

}  // namespace episcope
