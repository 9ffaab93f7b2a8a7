// SPDX-License-Identifier: BSD-3-Clause
#include "annotation/propagate.h"

#include "engine/core/error.h"
#include "engine/core/parallel.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace episcope {
namespace {

constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();

/// How far pixels move.
int largest_motion(const DisparityView& source, ViewIndex step) {
  float largest = 0;
  for (int y = 0; y < source.disparity.height; ++y) {
    for (int x = 0; x < source.disparity.width; ++x) {
      if (source.is_valid(y, x)) largest = std::max(largest, std::abs(source.disparity.at(y, x)));
    }
  }
  const int steps = std::max(std::abs(step.v), std::abs(step.u));
  const int extent = std::max(source.disparity.height, source.disparity.width);
  return static_cast<int>(
      std::ceil(std::min(largest * static_cast<float>(steps), static_cast<float>(extent))));
}

/// The nearest surface at each pixel. Surfaces at the border are taken to go on outside the
/// picture, so that they hide what they would there.
Image<float> splat(const DisparityView& source, ViewIndex step) {
  const ImageView<const float>& disparity = source.disparity;
  Image<float> nearest(disparity.height, disparity.width, 1, kUnknown);
  const int margin = largest_motion(source, step);
  for (int y = -margin; y < disparity.height + margin; ++y) {
    for (int x = -margin; x < disparity.width + margin; ++x) {
      const PixelIndex from{std::clamp(y, 0, disparity.height - 1),
                            std::clamp(x, 0, disparity.width - 1)};
      if (!source.is_valid(from.y, from.x)) continue;
      const float d = disparity.at(from.y, from.x);
      const float ty = std::round(static_cast<float>(y) - d * static_cast<float>(step.v));
      const float tx = std::round(static_cast<float>(x) - d * static_cast<float>(step.u));
      const bool is_inside = ty >= 0 && ty < static_cast<float>(disparity.height) && tx >= 0 &&
                             tx < static_cast<float>(disparity.width);
      if (!is_inside) continue;
      float& held = nearest.at(static_cast<int>(ty), static_cast<int>(tx));
      if (!(held >= d)) held = d;
    }
  }
  return nearest;
}

/// What a pixel between a and b should hold if these are parts of one surface in front of it.
float bridged(float a, float b, float held, float tolerance) {
  const bool is_surface = std::abs(a - b) <= tolerance;
  const bool is_behind = !(held >= std::min(a, b) - tolerance);
  return is_surface && is_behind ? (a + b) / 2 : held;
}

Image<float> close_cracks(const Image<float>& map, float tolerance) {
  Image<float> closed = map;
  for (int y = 0; y < map.height(); ++y) {
    for (int x = 0; x < map.width(); ++x) {
      float& held = closed.at(y, x);
      if (x > 0 && x + 1 < map.width()) {
        held = bridged(map.at(y, x - 1), map.at(y, x + 1), held, tolerance);
      }
      if (y > 0 && y + 1 < map.height()) {
        held = bridged(map.at(y - 1, x), map.at(y + 1, x), held, tolerance);
      }
    }
  }
  return closed;
}

// The disparity of a view as the view `step` further sees it, through a z-buffer: each pixel moves
// by −d·step to the nearest pixel, the nearest surface wins; those at the border go on outside.
// Pixels that none reaches are NaN, but cracks of one pixel between neighbors on both sides whose
// disparities agree within `tolerance_px` are closed, also where a farther surface shines through.
// A step of zero copies. Invalid pixels become NaN.
Image<float> warp_disparity(const DisparityView& source, ViewIndex step, double tolerance_px) {
  const Image<float> moved = splat(source, step);
  return step == ViewIndex{} ? moved : close_cracks(moved, static_cast<float>(tolerance_px));
}

int distance2(ViewIndex a, ViewIndex b) {
  return (a.v - b.v) * (a.v - b.v) + (a.u - b.u) * (a.u - b.u);
}

void require_fitting(const ScribbleLayer& painted, const DisparityField& field) {
  const ViewStack<float>& maps = field.disparity;
  if (field.empty()) throw InvalidInput("scribbles cannot be propagated without disparity");
  if (maps.height() != painted.height() || maps.width() != painted.width()) {
    throw InvalidInput(fmt::format(
        "scribbles on views of {}×{} px cannot be propagated with a disparity of {}×{} px",
        painted.width(), painted.height(), maps.width(), maps.height()));
  }
  const ViewIndex last{maps.first().v + maps.grid().v - 1, maps.first().u + maps.grid().u - 1};
  if (!painted.grid().contains(maps.first()) || !painted.grid().contains(last)) {
    throw InvalidInput("the disparity covers views up to (" + view_text(last) +
                       "), which the scribbles do not have");
  }
}

/// The disparity of any view; NaN where it is not known.
Image<float> disparity_of(const DisparityField& field, ViewIndex view, double tolerance_px) {
  const ViewStack<float>& maps = field.disparity;
  const ViewIndex nearest{std::clamp(view.v, maps.first().v, maps.first().v + maps.grid().v - 1),
                          std::clamp(view.u, maps.first().u, maps.first().u + maps.grid().u - 1)};
  return warp_disparity(field.view(nearest), {view.v - nearest.v, view.u - nearest.u},
                        tolerance_px);
}

struct PaintedView {
  ViewIndex view;
  ImageView<const std::uint8_t> labels;
  Image<float> disparity;
};

/// Labels of one view as seen from another.
class Carrier {
 public:
  Carrier(const PaintedView& source, ViewIndex target, double tolerance_px)
      : source_(source),
        step_{target.v - source.view.v, target.u - source.view.u},
        tolerance_(static_cast<float>(tolerance_px)) {}

  /// 0 if nothing is painted there or it cannot be seen from the source.
  [[nodiscard]] std::uint8_t label_at(int y, int x, float d) const {
    const auto sy = std::lround(static_cast<float>(y) + d * static_cast<float>(step_.v));
    const auto sx = std::lround(static_cast<float>(x) + d * static_cast<float>(step_.u));
    const bool is_inside =
        sy >= 0 && sy < source_.labels.height && sx >= 0 && sx < source_.labels.width;
    if (!is_inside) return 0;
    const auto row = static_cast<int>(sy);
    const auto column = static_cast<int>(sx);
    const std::uint8_t label = source_.labels.at(row, column);
    if (label == 0) return 0;
    // Not so for NaN, where the source knows no disparity.
    return std::abs(source_.disparity.at(row, column) - d) <= tolerance_ ? label : 0;
  }

 private:
  const PaintedView& source_;
  ViewIndex step_;
  float tolerance_;
};

void carry(const PaintedView& source, ViewIndex target, const Image<float>& disparity,
           double tolerance_px, ImageView<std::uint8_t> labels) {
  const Carrier carrier(source, target, tolerance_px);
  for (int y = 0; y < labels.height; ++y) {
    const float* d = disparity.row(y);
    std::uint8_t* row = labels.row(y);
    for (int x = 0; x < labels.width; ++x) {
      if (row[x] == 0 && std::isfinite(d[x])) row[x] = carrier.label_at(y, x, d[x]);
    }
  }
}

}  // namespace

ScribbleLayer propagate(const ScribbleLayer& painted, const DisparityField& field,
                        const PropagationOptions& options, const Progress& progress) {
  require_fitting(painted, field);
  const GridShape grid = painted.grid();
  ScribbleLayer derived(grid, painted.height(), painted.width());
  std::vector<PaintedView> sources;
  for (const ViewIndex view : painted.painted_views()) {
    progress.check();
    sources.push_back({view, painted.view(view), disparity_of(field, view, options.tolerance_px)});
  }
  if (sources.empty()) return derived;

  std::vector<ImageView<std::uint8_t>> targets;
  targets.reserve(static_cast<std::size_t>(grid.count()));
  for (int i = 0; i < grid.count(); ++i) {
    targets.push_back(derived.writable_view(grid.view_at(i)));
  }
  parallel_for(grid.count(), progress, [&](int i) {
    const ViewIndex target = grid.view_at(i);
    const ImageView<std::uint8_t> labels = targets[static_cast<std::size_t>(i)];
    const Image<float> disparity = disparity_of(field, target, options.tolerance_px);
    std::vector<const PaintedView*> by_distance;
    for (const PaintedView& source : sources) {
      if (!(source.view == target)) by_distance.push_back(&source);
    }
    std::ranges::stable_sort(by_distance, {}, [&](const PaintedView* source) {
      return distance2(source->view, target);
    });
    for (const PaintedView* source : by_distance) {
      progress.check();
      carry(*source, target, disparity, options.tolerance_px, labels);
    }
    const ImageView<const std::uint8_t> own = painted.view(target);
    for (std::size_t p = 0; p < own.size() && !own.empty(); ++p) {
      if (own.data[p] != 0) labels.data[p] = 0;
    }
  });
  return derived;
}

}  // namespace episcope
