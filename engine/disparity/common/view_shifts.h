// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/light_field/view_places.h"
#include "engine/disparity/common/matching_cost.h"

#include <array>
#include <numeric>
#include <vector>

namespace episcope {

/// The longest interpolation, in taps.
inline constexpr int kMaxShiftTaps = 4;

/// How one axis of a view is sampled at one label.
struct AxisShift {
  int origin = 0;   ///< Pixels from the reference pixel to the first tap,
  int nearest = 0;  ///< and to the pixel next to the sample, one of the taps.
  int taps = 1;
  std::array<float, kMaxShiftTaps> weights{1};
  /// Share of the variance of noise that the weights leave.
  [[nodiscard]] double noise_left() const {
    return std::inner_product(weights.begin(), weights.end(), weights.begin(), 0.0);
  }
  int first = 0, last = 0;  ///< Reference pixels whose sample lies within the image.
};

/// The ways along one axis from a reference, in steps: to every row (or column) of a regular grid,
[[nodiscard]] std::vector<double> regular_ways(int places, int reference);
/// and to every view, which stand at `places`.
[[nodiscard]] std::vector<double> stated_ways(const std::vector<ViewPlace>& places,
                                              std::size_t reference, double ViewPlace::*axis);

/// Shifts of one axis of `extent` pixels for every way along it and every label, `[way][label]`.
[[nodiscard]] std::vector<AxisShift> make_shifts(const std::vector<double>& ways, int extent,
                                                 Interpolation interpolation,
                                                 const std::vector<float>& labels);

/// For each label and reference pixel of one axis: in how many places it is seen, `[label][pixel]`.
[[nodiscard]] std::vector<float> count_seen(const std::vector<AxisShift>& shifts, int labels,
                                            int extent);

}  // namespace episcope
