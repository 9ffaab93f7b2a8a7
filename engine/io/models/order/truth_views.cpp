// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/models/order/truth_views.h"

#include "engine/core/finding.h"
#include "engine/io/models/order/motion_pictures.h"
#include "engine/io/models/order/view_axes.h"
#include "engine/io/models/order/warp_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string_view>
#include <utility>

namespace episcope::io {
namespace {

/// Of the misfit as stored.
constexpr double kFarBetterOrder = 0.6;
/// Maps rounded to whole pixels differ by as much.
constexpr double kSmallMisfit_px = 0.01;

std::vector<StoredOrder> other_orders(GridShape grid) {
  std::vector<StoredOrder> orders;
  for (const bool is_transposed : {true, false}) {
    if (is_transposed && grid.v != grid.u) continue;
    for (const ViewFlip flip : {ViewFlip{}, {true, false}, {false, true}, {true, true}}) {
      if (is_transposed || !(flip == ViewFlip{})) orders.push_back({is_transposed, flip});
    }
  }
  return orders;
}

/// Views that each order has elsewhere: a corner, and the middles of two sides.
std::vector<ViewIndex> telling_views(GridShape grid) {
  const ViewIndex center = grid.center();
  std::vector<ViewIndex> views{{0, grid.u - 1}};
  if (center.v > 0 && center.u > 0) views.insert(views.end(), {{0, center.u}, {center.v, 0}});
  return views;
}

}  // namespace

std::string StoredOrder::text() const {
  const std::string transposed(finding_text("truth.views_transposed"));
  if (flip == ViewFlip{}) return transposed;
  return is_transposed ? transposed + ", " + flip_text(flip) : flip_text(flip);
}

std::optional<BetterOrder> find_better_order(
    GridShape grid, double small_misfit,
    const std::function<Misfit(ViewIndex view, ViewIndex place)>& misfit_of) {
  const auto misfit_by = [&](const StoredOrder& order) {
    Misfit sum;
    for (const ViewIndex view : telling_views(grid))
      sum += misfit_of(view, order.place(view, grid));
    return sum.mean();
  };
  BetterOrder found{{}, 0, misfit_by({})};
  found.misfit = kFarBetterOrder * found.as_stored;
  bool is_better = false;
  for (const StoredOrder& order : other_orders(grid)) {
    const double misfit = misfit_by(order);
    if (found.as_stored < small_misfit || misfit >= found.misfit) continue;
    found.order = order;
    found.misfit = misfit;
    is_better = true;
  }
  return is_better ? std::optional(found) : std::nullopt;
}

namespace {

/// Compares the map with the center view, which shows the same points in places that the
/// disparities tell, but for what is hidden. In px.
Misfit misfit_of_map(const DisparityField& field, ViewIndex view, ViewIndex place) {
  constexpr double kHidden_px = 0.25;
  constexpr double kMost_px = 1;  // more is no more wrong
  const ViewIndex center = field.disparity.grid().center();
  const DisparityView shown = field.view(center);
  Misfit misfit;
  for (const MapPoint& point : spread_points(field.view(place))) {
    const auto x = std::lround(point.x + point.disparity * (view.u - center.u));
    const auto y = std::lround(point.y + point.disparity * (view.v - center.v));
    const bool is_inside =
        y >= 0 && y < shown.disparity.height && x >= 0 && x < shown.disparity.width;
    const int row = static_cast<int>(y), column = static_cast<int>(x);
    if (!is_inside || !shown.is_valid(row, column)) continue;
    const double off = point.disparity - shown.disparity.at(row, column);
    if (off < -kHidden_px) continue;  // by something nearer
    misfit += {std::min(std::abs(off), kMost_px), 1};
  }
  return misfit;
}

/// Compares edges of labels with the contrast of a picture there: pixels for each unit of contrast.
Misfit misfit_of_labels(const ImageView<const std::int32_t>& labels, const Image<float>& picture) {
  Misfit misfit;
  for (int y = 1; y + 2 < picture.height(); ++y) {
    for (int x = 1; x + 2 < picture.width(); ++x) {
      for (const auto& [dy, dx] : {std::pair(0, 1), std::pair(1, 0)}) {
        if (labels.at(y, x) == labels.at(y + dy, x + dx)) continue;
        const float before = picture.at(y - dy, x - dx);
        misfit += {1, std::abs(before - picture.at(y + 2 * dy, x + 2 * dx))};
      }
    }
  }
  return misfit;
}

/// 0 where there is no value.
Image<float> picture_of_map(const DisparityView& map) {
  Image<float> picture(map.disparity.height, map.disparity.width);
  for (int y = 0; y < picture.height(); ++y) {
    for (int x = 0; x < picture.width(); ++x) {
      picture.at(y, x) = map.is_valid(y, x) ? map.disparity.at(y, x) : 0;
    }
  }
  return picture;
}

}  // namespace

std::vector<std::string> put_truth_views_in_order(const LightField::Samples& samples,
                                                  GroundTruth& truth) {
  std::vector<std::string> warnings;
  const GridShape grid = grid_of(samples);
  if (grid.count() == 1) return warnings;
  const auto turn = [&](auto& maps, std::string_view what, const StoredOrder& order,
                        const std::string& why) {
    reverse_views(maps, grid, order.flip);
    if (order.is_transposed) swap_view_axes(maps);
    warnings.push_back(fmt::format(finding_text("truth.views_turned"), what, order.text(), why));
  };
  const bool has_maps = truth.field.disparity.grid() == grid;
  const auto of_maps = [&](ViewIndex view, ViewIndex place) {
    return misfit_of_map(truth.field, view, place);
  };
  if (const auto found =
          has_maps ? find_better_order(grid, kSmallMisfit_px, of_maps) : std::nullopt) {
    turn(truth.field, finding_text("truth.maps"), found->order,
         fmt::format(finding_text("truth.views_misfit"), found->misfit, found->as_stored));
  }
  if (!(truth.labels.grid() == grid)) return warnings;
  const auto of_labels = [&](ViewIndex view, ViewIndex place) {
    return misfit_of_labels(truth.labels.view(place), has_maps
                                                          ? picture_of_map(truth.field.view(view))
                                                          : smoothed(grey_levels(samples, view)));
  };
  if (const auto found = find_better_order(grid, 0, of_labels)) {
    turn(truth.labels, finding_text("truth.labels"), found->order,
         fmt::format(fmt::runtime(has_maps ? finding_text("truth.views_jumps")
                                           : finding_text("truth.views_contrast")),
                     1 / found->misfit, 1 / found->as_stored));
  }
  return warnings;
}

}  // namespace episcope::io
