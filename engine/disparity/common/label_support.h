// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/light_field/light_field.h"
#include "engine/core/parallel/progress.h"

#include <vector>

namespace episcope {

/// The share in [0, 1] of the pixels of the centre view that match the views of its row and column
/// best at each label (disparity, px per view step), each pixel by itself, on some rows of the
/// image. Pixels that match all labels alike or are not valid do not count. A repeated pattern that
/// suits a few neighbouring views at a wrong disparity hardly suits all of them, so that wrong
/// labels get less than 0.1 % each. Throws Cancelled, InvalidInput for a single view.
[[nodiscard]] std::vector<double> label_support(const LightField& light_field,
                                                const std::vector<float>& labels,
                                                const Progress& progress);

}  // namespace episcope
