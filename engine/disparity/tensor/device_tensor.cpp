// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/tensor/device_tensor.h"

#include <algorithm>
#include <cassert>

namespace episcope {
namespace {

std::vector<cuda::ViewFilter> view_filters(const std::vector<RowTaps>& rows) {
  static_assert(cuda::ViewFilter::kMaxTaps == kMaxTaps);
  std::vector<cuda::ViewFilter> filters(rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    filters[i].first = rows[i].first;
    filters[i].count = rows[i].count;
    std::copy_n(rows[i].values, rows[i].count, filters[i].taps);
  }
  return filters;
}

cuda::ViewFilters view_filters(const TensorFilterSet& set) {
  return {view_filters(set.row_smooth), view_filters(set.row_derivative),
          view_filters(set.row_integrate), set.view_reach};
}

std::vector<float> lane_filter(const Taps& taps, int more = 0) {
  return {taps.values, taps.values + 2 * taps.radius + 1 + more};
}

void set_shears(const std::vector<int>& shears, cuda::TensorSettings& settings) {
  settings.first_shear = shears.front();
  settings.shear_count = static_cast<int>(shears.size());
  settings.shear_step = shears.size() > 1 ? shears[1] - shears[0] : 0;
  assert(shears.back() == shears.front() + (settings.shear_count - 1) * settings.shear_step);
}

}  // namespace

cuda::TensorSettings device_tensor_settings(const LightField& lf, const TensorScales& scales,
                                            const TensorSearch& search) {
  using Direction = StructureTensor::Direction;
  cuda::TensorSettings settings;
  const auto add_direction = [&](Direction direction, cuda::ViewFilters& filters) {
    const TensorFilterSet set =
        make_tensor_filters(StructureTensor::views_along(lf, direction), lf.channels(), scales);
    filters = view_filters(set);
    settings.smooth = lane_filter(set.filters.smooth);
    settings.integrate = lane_filter(set.filters.integrate);
    settings.integrate_half = lane_filter(set.filters.integrate_half, 1);
    settings.across = lane_filter(set.across);
    settings.contrast_energy = set.filters.contrast_energy;
    settings.noise_energy = set.filters.noise_energy;
  };
  if (lf.grid().u > 1) add_direction(Direction::Horizontal, settings.horizontal);
  if (lf.grid().v > 1) add_direction(Direction::Vertical, settings.vertical);
  set_shears(search.half_step_shears, settings);
  settings.limit = static_cast<float>(search.limit);
  settings.min = static_cast<float>(search.accepted.min);
  settings.max = static_cast<float>(search.accepted.max);
  settings.eigenvector = search.eigenvector;
  return settings;
}

}  // namespace episcope
