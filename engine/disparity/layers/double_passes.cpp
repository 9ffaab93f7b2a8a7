// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/layers/double_passes.h"

#include "engine/disparity/layers/double_filters.h"

#include <algorithm>

namespace episcope {
namespace {

cuda::DoubleTaps device_taps(const Taps& taps) {
  cuda::DoubleTaps copy;
  copy.radius = taps.radius;
  std::copy_n(taps.values, 2 * taps.radius + 1, copy.values);
  return copy;
}

cuda::DoublePass device_pass(const LightField& lf, const TensorScales& scales,
                             const DoubleSearch& search, bool is_horizontal) {
  const DoubleFilterSet set =
      make_double_filters(is_horizontal ? lf.grid().u : lf.grid().v, lf.channels(), scales);
  const PixelIndex tile =
      DoubleOrientation::tile(is_horizontal ? DoubleOrientation::Direction::Horizontal
                                            : DoubleOrientation::Direction::Vertical);
  const SecondOrderFilters& filters = set.filters;
  cuda::DoublePass pass;
  pass.is_horizontal = is_horizontal;
  for (int order = 0; order < 3; ++order) {
    pass.along[order] = device_taps(filters.along[order]);
    pass.views[order] = device_taps(filters.views[order]);
    pass.scale[order] = filters.scale[order];
  }
  pass.integrate = device_taps(filters.integrate);
  pass.across = device_taps(filters.across);
  pass.mix = filters.mix;
  pass.contrast_energy = filters.contrast_energy;
  pass.noise_energy = filters.noise_energy;
  pass.first_product = set.first_product;
  pass.last_product = set.last_product;
  pass.row_weights = set.row_weights;
  pass.tile_height = tile.y;
  pass.tile_width = tile.x;
  pass.tile_stride = search.tile_stride;
  return pass;
}

}  // namespace

DevicePasses device_passes(const LightField& lf, const TensorScales& scales,
                           const DoubleSearch& search) {
  DevicePasses made;
  for (const bool is_horizontal : {true, false}) {
    const int views = is_horizontal ? lf.grid().u : lf.grid().v;
    if (views < DoubleOrientation::kMinViews) continue;
    made.passes.push_back(device_pass(lf, scales, search, is_horizontal));
  }
  made.shears = {double_steps(search), kDoubleShearReach, static_cast<float>(search.accepted.min),
                 static_cast<float>(search.accepted.max), static_cast<float>(search.min_distance)};
  return made;
}

}  // namespace episcope
