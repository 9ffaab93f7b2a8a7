// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/light_field.h"

#include <optional>
#include <vector>

namespace episcope::io {

/// Pixel of a view, and a number on which its disparity depends in an unknown way.
struct ValuePoint {
  int y = 0;
  int x = 0;
  double value = 0;
};

/// Relation fitted to the views: d = `slope` · value + `offset` in px per view step.
struct ShiftFit {
  double slope = 0;
  double offset = 0;
  double error = 0;     ///< Mean grey error (0 … 255) of the next views, warped by it,
  double unwarped = 0;  ///< and as they are.
  double deviation =
      0;  ///< Of eight parts of the values, the largest error of their mean d, in px.
};

/// Finds the slope and offset of least grey error: moves the pixels by d into the neighbors of
/// `at`, whichever way rows and columns of views run. Searches shifts of up to a twelfth of the
/// width, then takes Gauss-Newton steps, also with views two and four steps away. The slope comes
/// out positive. Returns nothing if the values do not explain the motion: if a constant disparity
/// does nearly as well, if a part of the values moves otherwise by more than 0.05 px and a
/// hundredth of the range of d, or if fewer than three different values can be told apart. Linear
/// in the points.
[[nodiscard]] std::optional<ShiftFit> fit_shift(const LightField::Samples& samples, ViewIndex at,
                                                const std::vector<ValuePoint>& points);

}  // namespace episcope::io
