// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/array/image.h"

#include <vector>

namespace episcope::io {

/// Two neighbouring views, in one of several planes of an array.
struct PlaneViews {
  Image<float> center;
  Image<float> neighbour;  ///< To the left or right of it, or above.
  bool is_above = false;
};

/// Whether planes of one size show scenes of their own, and are not the channels of one. No two of
/// them may be correlated, neither as a whole nor in the median of squares of 16 px: channels of
/// colour are at 0.9 as a rule, those of saturated colours without texture at 0.6 by one of the two
/// measures; pictures of different scenes are below 0.4 by both. And squares must move differently
/// from view to view, by more than 0.2 px in the median. False where a plane is of one value, as
/// weights are.
[[nodiscard]] bool are_unlike(const std::vector<PlaneViews>& planes);

}  // namespace episcope::io
