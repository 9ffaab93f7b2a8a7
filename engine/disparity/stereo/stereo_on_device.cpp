// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/stereo/stereo_on_device.h"

#include "engine/disparity/common/view_shifts.h"

#include <algorithm>
#include <cmath>

namespace episcope {
namespace {

std::vector<cuda::MatchShift> device_shifts(const std::vector<AxisShift>& shifts) {
  std::vector<cuda::MatchShift> result;
  result.reserve(shifts.size());
  for (const AxisShift& shift : shifts) {
    cuda::MatchShift& each = result.emplace_back();
    std::ranges::copy(shift.weights, each.weights);
    each.origin = shift.origin;
    each.taps = shift.taps;
    each.first = shift.first;
    each.last = shift.last;
    each.nearest = shift.nearest;
    each.noise_left = shift.noise_left();
  }
  return result;
}

// In the order in which the CPU adds them.
std::vector<cuda::MatchedView> matched_views(GridShape grid, ViewIndex reference,
                                             const MatchingCost& cost) {
  std::vector<cuda::MatchedView> views;
  for (int i = 0; i < grid.count(); ++i) {
    const ViewIndex view = grid.view_at(i);
    const bool on_cross = view.v == reference.v || view.u == reference.u;
    if (view == reference || (cost.views == MatchedViews::CrossHair && !on_cross)) continue;
    views.push_back({view, cost.places ? i : view.v, cost.places ? i : view.u});
  }
  return views;
}

}  // namespace

cuda::StereoMatching device_matching(const LightField& lf, ViewIndex reference,
                                     const MatchingCost& cost, const std::vector<float>& labels) {
  check_matching(lf, reference);
  const GridShape grid = lf.grid();
  const int count = static_cast<int>(labels.size());
  const auto shifts = [&](int places, int at, double ViewPlace::*axis, int extent) {
    const std::size_t index = static_cast<std::size_t>(reference.v) * grid.u + reference.u;
    return make_shifts(
        cost.places ? stated_ways(*cost.places, index, axis) : regular_ways(places, at), extent,
        cost.interpolation, labels);
  };
  const std::vector<AxisShift> rows = shifts(grid.v, reference.v, &ViewPlace::v, lf.height());
  const std::vector<AxisShift> columns = shifts(grid.u, reference.u, &ViewPlace::u, lf.width());
  cuda::StereoMatching matching;
  matching.views = matched_views(grid, reference, cost);
  matching.labels = count;
  matching.disparities = labels;
  matching.rows = device_shifts(rows);
  matching.columns = device_shifts(columns);
  if (lf.valid().empty() && !cost.places) {
    matching.rows_seen = count_seen(rows, count, lf.height());
    matching.columns_seen = count_seen(columns, count, lf.width());
  }
  matching.is_cross_hair = cost.views == MatchedViews::CrossHair;
  matching.cap = static_cast<float>(cost.cap);
  matching.worst =
      static_cast<float>(std::min(cost.cap, std::sqrt(static_cast<double>(lf.channels()))));
  return matching;
}

cuda::LabelPlaces::Refinement device_refinement(Refinement refinement) {
  using To = cuda::LabelPlaces::Refinement;
  if (refinement == Refinement::Parabola) return To::Parabola;
  return refinement == Refinement::Equiangular ? To::Equiangular : To::None;
}

}  // namespace episcope
