// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/light_field.h"
#include "engine/core/progress.h"

#include <array>
#include <vector>

namespace episcope {

/// Differences in brightness between the views and a reference view.
struct Brightness {
  /// Of every view and channel, 1 for the reference; alike of a single channel; empty = all 1.
  std::vector<std::array<double, 3>> gains;
  /// k of the fall-off 1 − k·r² that all views have, r² = 1 in the corners.
  double fall_off = 0;
  /// Whether it is worth a correction: root mean square of log gains above 0.5 %, or |k| > 0.1.
  [[nodiscard]] bool is_uneven() const;
};

/// Gains by the means of whole views alone, before anything is known of their disparity. Objects
/// that come into a view change its mean as well, but steadily from view to view: where means are
/// off the mean of their neighbors' in a row by no more than 0.5 % gains would explain, all gains
/// are 1. Throws Cancelled.
[[nodiscard]] Brightness brightness_of_means(const LightField& light_field, ViewIndex reference,
                                             const Progress& progress);

/// Gains and fall-off by the ratios of the samples of corresponding points: medians over some
/// pixels of the reference, whose `disparity` is given (kNothingNear = not known), and a fall-off
/// that makes them least different. Samples in [0, 1], of which the darkest and the brightest do
/// not count. Throws Cancelled.
[[nodiscard]] Brightness brightness_of_points(const LightField& light_field, ViewIndex reference,
                                              ImageView<const float> disparity,
                                              const Progress& progress);

/// The light field without gains and fall-off, in 16 bits, at most 1. Throws Cancelled.
[[nodiscard]] LightField even_views(const LightField& light_field, const Brightness& brightness,
                                    const Progress& progress);

}  // namespace episcope
