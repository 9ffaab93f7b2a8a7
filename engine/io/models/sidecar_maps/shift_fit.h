// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/light_field.h"

#include <optional>
#include <vector>

namespace episcope::io {

/// A pixel of a view, and a number on which its disparity depends in an unknown way.
struct ValuePoint {
  int y = 0;
  int x = 0;
  double value = 0;
};

/// d = `slope` · value + `offset` in px per view step, as the views themselves say.
struct ShiftFit {
  double slope = 0;
  double offset = 0;
  double error = 0;     ///< Mean grey error (0 … 255) of the next views, warped by it,
  double unwarped = 0;  ///< and as they are.
  double deviation =
      0;  ///< Of eight parts of the values, the largest error of their mean d, in px.
};

/// Moves the pixels by d into the views next to `at`, whichever way their rows and columns run, and
/// finds slope and offset with the least grey error: first among shifts of up to a twelfth of the
/// width, then by Gauss-Newton steps, also into views two and four steps away. The slope comes out
/// positive. Nothing if the values do not explain the motion: if it is hardly better than one
/// disparity for all, if a part of the values moves otherwise by more than 0.05 px and a hundredth
/// of the range of d, or if less than three different ones can be told apart. Linear in the points.
[[nodiscard]] std::optional<ShiftFit> fit_shift(const LightField::Samples& samples, ViewIndex at,
                                                const std::vector<ValuePoint>& points);

}  // namespace episcope::io
