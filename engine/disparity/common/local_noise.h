// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/array/image.h"
#include "engine/core/light_field/light_field.h"
#include "engine/core/parallel/progress.h"

namespace episcope {

/// The noise variance around each pixel of a view, `[y][x]`, mean over the channels, samples in [0,
/// 1]: the mean square of second differences a − 2b + c over windows of 5×5 px, divided by 6, in
/// the direction of four in which it is smallest, so that edges do not count. An upper bound: fine
/// texture counts as noise. The outermost pixels use the differences of their neighbours.
/// 0 for views of less than 3×3 px. Throws Cancelled.
[[nodiscard]] Image<float> local_noise_variance(const LightField& light_field, ViewIndex view,
                                                const Progress& progress);

/// The noise variance of a whole view: the median of the local ones, in which edges, texture in
/// places and shadows hardly count. Throws Cancelled.
[[nodiscard]] double view_noise_variance(const LightField& light_field, ViewIndex view,
                                         const Progress& progress);

/// The same of one map, in the square of its unit.
[[nodiscard]] Image<float> local_noise_variance(ImageView<const float> map,
                                                const Progress& progress);

}  // namespace episcope
