// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/array/image.h"

#include <vector>

namespace episcope::io {

/// Whether pictures of one size show scenes of their own, and not the channels of one: no two of
/// them are correlated, neither as a whole nor in the median of their squares of 16 px. Channels of
/// colour are at 0.9 as a rule, those of saturated colours without texture at 0.6 by one of the two
/// measures; pictures of different scenes are below 0.4 by both. False where a picture is of one
/// value, as a weight is.
[[nodiscard]] bool are_unlike(const std::vector<Image<float>>& pictures);

}  // namespace episcope::io
