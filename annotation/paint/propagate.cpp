// SPDX-License-Identifier: BSD-3-Clause
#include "annotation/paint/propagate.h"

#include "annotation/paint/warp_disparity.h"
#include "engine/core/error.h"
#include "engine/core/parallel/parallel.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace episcope {
namespace {

int distance2(ViewIndex a, ViewIndex b) {
  return (a.v - b.v) * (a.v - b.v) + (a.u - b.u) * (a.u - b.u);
}

void require_fitting(const ScribbleLayer& painted, const DisparityField& field) {
  const ViewStack<float>& maps = field.disparity;
  if (field.empty()) throw InvalidInput("scribbles cannot be propagated without disparity");
  if (maps.height() != painted.height() || maps.width() != painted.width()) {
    throw InvalidInput(fmt::format(
        "scribbles on views of {}×{} px cannot be propagated with a disparity of {}×{} px",
        painted.height(), painted.width(), maps.height(), maps.width()));
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
