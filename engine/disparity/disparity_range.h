// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/light_field.h"
#include "engine/core/parameter.h"
#include "engine/core/progress.h"

#include <optional>
#include <string>
#include <vector>

namespace episcope {

/// How often each disparity is seen in the center view, by the structure tensor on some rows and
/// columns of its EPIs, sheared in whole pixels. Of the pixels, those count whose orientation is
/// coherent; under noise fewer pixels are, and the threshold is lowered.
class OrientationHistogram {
 public:
  /// Width of a cell, px per view step.
  static constexpr double kCell = 0.05;

  /// Looks at disparities of ±`limit`. Throws InvalidInput as StructureTensor, Cancelled.
  OrientationHistogram(const LightField& light_field, double limit, const Progress& progress);

  /// Pixels counted, before any cell was cleared.
  [[nodiscard]] double total() const { return total_; }
  [[nodiscard]] int size() const { return static_cast<int>(cells_.size()); }
  /// The disparity in the middle of a cell.
  [[nodiscard]] double middle(int cell) const { return (cell + 0.5) * kCell - limit_; }
  void clear(int cell) { cells_[cell] = 0; }

  /// From the first to the last 0.2 px that hold `tail` of all pixels. Orientations that noise
  /// alone gives are spread thinly over all disparities; what is seen lies close together, and
  /// counts even where few of its pixels are coherent. A part of the 0.2 px is the margin. None if
  /// too few cells are left.
  [[nodiscard]] std::optional<Interval> ends(double tail) const;

 private:
  double limit_;
  std::vector<double> cells_;
  double total_ = 0;
};

/// Where pixels of the center view distinctly match: of those on some rows that match the views of
/// its row and column, 3×3 px at a time, at one label (disparity, px per view step) much better
/// than at any label 0.75 px or more away, the share that does so at each label, in [0, 1]. They
/// add up to 1, or to 0 if no pixel matches so. A repeated pattern suits several labels, and what
/// noise alone suits is not much better than the next: neither counts. Throws Cancelled,
/// InvalidInput for a single view.
[[nodiscard]] std::vector<double> label_support(const LightField& light_field,
                                                const std::vector<float>& labels,
                                                const Progress& progress);

/// The disparity at which a block of 7×7 pixels around a pixel of a view matches the views of its
/// row and column best, px per view step. None where nothing in `range` matches distinctly
/// (label_support). A quick answer for one pixel: estimators do better. Throws Cancelled,
/// InvalidInput for a single view.
[[nodiscard]] std::optional<double> matched_disparity(const LightField& light_field, ViewIndex view,
                                                      PixelIndex pixel, Interval range,
                                                      const Progress& progress);

/// Where a range to search comes from.
enum class RangeSource { Given, Promised, Found };
[[nodiscard]] RangeSource range_source(const LightField& light_field, const IntervalOrAuto& wanted);

/// "disparity range -1.65 … 1.50 px, found from the images".
[[nodiscard]] std::string found_range_note(Interval range);

/// The range "found" where nothing matches.
inline constexpr Interval kNothingSeen{-1, 1};

/// The disparity beyond which nothing is looked for when a range is found, px per view step.
[[nodiscard]] double farthest_found(const LightField& light_field);

/// A sentence for a range found that ends at `farthest_found`, where nothing says that the scene
/// ends too, and for `kNothingSeen`; else empty.
[[nodiscard]] std::string limited_range_note(const LightField& light_field, Interval range);

/// A sentence for a given range that holds nothing of what would be found; else empty. Looks for
/// that unless the range was found before. Throws Cancelled.
[[nodiscard]] std::string foreign_range_note(const LightField& light_field, Interval given);

/// Help of a parameter that is a range to search.
inline constexpr const char* kRangeHelp =
    "Range of disparities to search; automatic (auto): from the files, else found from the images; "
    "found: from the images, whatever the files say";

/// The disparity range that an estimator should search, px per view step: `wanted` if given, else
/// what the files promise (LightFieldInfo::disparity_range) unless it is to be found, else found
/// from the light field itself, once for the runs that follow on it. No estimator ever sees the
/// truth. Thread-safe. Throws Cancelled.
[[nodiscard]] Interval search_range(const LightField& light_field, const IntervalOrAuto& wanted,
                                    const Progress& progress);

/// Estimates the range by a coarse, robust pass in two ways. What blocks of pixels match in views
/// reduced to about 128 px and in smaller ones (certain_range) is certain but for their doubts,
/// whatever noise, darkness or vignetting there is; blocks average, so the range goes a little
/// beyond them. What single pixels see is exact but full of aliases: the span between the first and
/// the last disparities that hold a small fraction of the coherent orientations on some rows and
/// columns of the center view's EPIs, sheared in whole pixels over ±16 px or a sixth of the image
/// (OrientationHistogram). It widens the range by 0.45 px at most, and farther only where views of
/// half the size confirm it by matching distinctly (label_support). A light field without texture
/// gives `kNothingSeen`. Throws Cancelled.
[[nodiscard]] Interval find_disparity_range(const LightField& light_field,
                                            const Progress& progress);

}  // namespace episcope
