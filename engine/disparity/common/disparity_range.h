// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/light_field/light_field.h"
#include "engine/core/parallel/progress.h"
#include "engine/core/parameter/parameter.h"

#include <string>

namespace episcope {

/// Where a range to search comes from.
enum class RangeSource { Given, Promised, Found };
[[nodiscard]] RangeSource range_source(const LightField& light_field, const IntervalOrAuto& wanted);

/// "disparity range -1.65 … 1.50 px, found from the images".
[[nodiscard]] std::string found_range_note(Interval range);

/// The disparity beyond which nothing is looked for when a range is found, px per view step.
[[nodiscard]] double farthest_found(const LightField& light_field);

/// A sentence for a range found that ends at `farthest_found`, where nothing says that the scene
/// ends too; else empty.
[[nodiscard]] std::string limited_range_note(const LightField& light_field, Interval range);

/// Help of a parameter that is a range to search.
inline constexpr const char* kRangeHelp =
    "Range of disparities to search; auto takes it from the files or finds it from the images, "
    "found finds it from the images whatever the files say";

/// The disparity range that an estimator should search, px per view step: `wanted` if given, else
/// what the files promise (LightFieldInfo::disparity_range) unless it is to be found, else found
/// from the light field itself, once for the runs that follow on it. No estimator ever sees the
/// truth. Thread-safe. Throws Cancelled.
[[nodiscard]] Interval search_range(const LightField& light_field, const IntervalOrAuto& wanted,
                                    const Progress& progress);

/// Estimates the range by a coarse, robust pass: the structure tensor on some rows and columns of
/// the centre view's EPIs, sheared in whole pixels over ±16 px or a sixth of the image
/// (orientation_histogram.h), and the span between the first and the last disparities that hold a
/// small fraction of the coherent pixels and that some pixels confirm by matching distinctly
/// (label_support.h). The same at half and a quarter of the size (smaller_views.h), which shows
/// what noise or blur hide, may widen the range. A light field without texture gives [−1, 1].
/// Throws Cancelled.
[[nodiscard]] Interval find_disparity_range(const LightField& light_field,
                                            const Progress& progress);

}  // namespace episcope
