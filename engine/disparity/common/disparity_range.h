// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/light_field/light_field.h"
#include "engine/core/parallel/progress.h"
#include "engine/core/parameter/parameter.h"

namespace episcope {

/// The disparity range that an estimator should search, px per view step: `wanted` if given, else
/// what the files promise (LightFieldInfo::disparity_range), else found from the light field
/// itself. No estimator ever sees the truth. Throws Cancelled.
[[nodiscard]] Interval search_range(const LightField& light_field, const IntervalOrAuto& wanted,
                                    const Progress& progress);

/// Estimates the range by a coarse, robust pass: the structure tensor on every few rows and columns
/// of the centre view's EPIs, sheared in whole pixels over ±`limit`, and the span between the first
/// and the last 0.2 px that hold a small fraction of the coherent pixels. Under noise fewer pixels
/// are coherent, and the threshold is lowered. A light field without texture gives [−1, 1].
[[nodiscard]] Interval find_disparity_range(const LightField& light_field, const Progress& progress,
                                            double limit = 5);

}  // namespace episcope
