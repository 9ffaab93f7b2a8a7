// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/disparity/layers/double_orientation.h"
#include "engine/disparity/layers/double_orientation_kernel.h"

#include <vector>

namespace episcope {

/// The filters of double orientations over an EPI of some views, with the memory they live in.
struct DoubleFilterSet {
  SecondOrderFilters filters;               ///< Its weights point into the vector below.
  std::vector<float> row_weights;           ///< `[row][product row]`
  int first_product = 0, last_product = 0;  ///< Views [first, last) where derivatives exist.
};
[[nodiscard]] DoubleFilterSet make_double_filters(int rows, int channels,
                                                  const TensorScales& scales);

/// Shears: whole pixels near every mean that two accepted disparities can have.
[[nodiscard]] std::vector<int> double_steps(const DoubleSearch& search);
/// Half the distance of shears and some overlap, px.
inline constexpr float kDoubleShearReach = 0.6F;

}  // namespace episcope
