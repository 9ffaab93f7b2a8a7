// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/light_field/light_field.h"
#include "engine/core/parallel/progress.h"

#include <vector>

namespace episcope {

/// Where pixels of the centre view distinctly match: of those on some rows that match the views of
/// its row and column, 3×3 px at a time, at one label (disparity, px per view step) much better
/// than at any label 0.75 px or more away, the share that does so at each label, in [0, 1]. They
/// add up to 1, or to 0 if no pixel matches so. A repeated pattern suits several labels, and what
/// noise alone suits is not much better than the next: neither counts. Throws Cancelled,
/// InvalidInput for a single view.
[[nodiscard]] std::vector<double> label_support(const LightField& light_field,
                                                const std::vector<float>& labels,
                                                const Progress& progress);

}  // namespace episcope
