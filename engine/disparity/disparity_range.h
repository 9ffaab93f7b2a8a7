// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/image.h"
#include "engine/core/light_field.h"
#include "engine/core/parameter.h"
#include "engine/core/progress.h"

#include <optional>
#include <string>
#include <vector>

namespace episcope {

/// How often each disparity is seen.
class DisparityHistogram {
 public:
  /// Width of a cell, px per view step.
  static constexpr double kCell = 0.05;

  /// Of disparities of ±`limit`; what lies beyond counts as there.
  explicit DisparityHistogram(double limit);

  void add(double disparity);
  [[nodiscard]] double total() const { return total_; }

  /// From the first to the last 0.2 px that hold `tail` of all, less 0.05 px. What noise alone
  /// gives is spread thinly over all disparities; what is seen lies close together, and counts even
  /// where few see it. None if nothing was added.
  [[nodiscard]] std::optional<Interval> ends(double tail) const;

 private:
  double limit_;
  std::vector<double> cells_;
  double total_ = 0;
};

/// Which views are made smaller: those in the row and the column of the center view, or all.
enum class ReducedViews { CrossHair, All };

/// Views of which each sample is the mean of `factor` × `factor` pixels, as uint16: noise is
/// `factor` times weaker, disparities are `factor` times smaller. Other views are black. Blocks
/// that the border or an invalid pixel cuts are left out or not valid. Precondition: factor ≤
/// height and width. Throws Cancelled.
[[nodiscard]] LightField smaller_views(const LightField& light_field, int factor,
                                       const Progress& progress,
                                       ReducedViews reduced = ReducedViews::CrossHair);

/// The disparity in `range`, px per view step, that pixels of some rows of the center view
/// distinctly match, `[row][x]`: where 3×3 px match the views of the center's row and column much
/// better than 0.75 px or more away. NaN where there is none: a repeated pattern suits several
/// disparities, and what noise alone suits is not much better than the next. Throws Cancelled,
/// InvalidInput for a single view.
[[nodiscard]] Image<float> distinct_matches(const LightField& light_field,
                                            const std::vector<int>& rows, Interval range,
                                            const Progress& progress);

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

/// Estimates the range by a coarse, robust pass over 64 rows of the center view. A pixel tells a
/// disparity if two estimates of it agree: the orientation of one of its EPIs, by the structure
/// tensor, sheared in whole pixels over ±16 px or a sixth of the image, and what it distinctly
/// matches in the views of both directions (distinct_matches). The range is the span between the
/// first and the last disparities that hold a small fraction of these pixels (DisparityHistogram).
/// The same at half and a quarter of the size (smaller_views), which shows what noise or blur hide,
/// may widen the range. A light field without texture gives [−1, 1]. Throws Cancelled.
[[nodiscard]] Interval find_disparity_range(const LightField& light_field,
                                            const Progress& progress);

}  // namespace episcope
