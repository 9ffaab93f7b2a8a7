// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tests/accuracy/measure.h"

#include <string>
#include <vector>

namespace episcope::accuracy {

/// A range found from the images beside that of the truth, px per view step.
struct FoundRange {
  std::string group;  ///< The set of scenes, and which part of it.
  std::string scene;
  Interval found;
  Interval truth;
  double covered = 0;  ///< Share of the pixels of the center view that `found` holds, in [0, 1].
  double seconds = 0;

  /// The greatest width that a range found may have.
  [[nodiscard]] double widest() const { return 1.25 * truth.length() + 0.3; }
  [[nodiscard]] bool is_narrow() const { return found.length() <= widest(); }
  [[nodiscard]] bool covers() const { return covered >= 0.995; }
};

/// The scene must have truth for its center view. Throws as find_disparity_range.
[[nodiscard]] FoundRange find_range(const Scene& scene, const Progress& progress);

/// The head of a Markdown table of ranges, a row, and how many of the ranges pass.
[[nodiscard]] std::string ranges_head();
[[nodiscard]] std::string ranges_row(const FoundRange& range);
[[nodiscard]] std::string ranges_summary(const std::vector<FoundRange>& ranges);

/// Errors of a method that searches the true range, and one of the same middle and twice the width.
struct TwiceRange {
  Measurement once;
  Measurement twice;

  /// Of the errors, those below `kLeastMse` as that.
  [[nodiscard]] double ratio() const;
};

/// Throws as the estimator, InvalidInput if it has no range.
[[nodiscard]] TwiceRange measure_twice(const std::string& name, const Scene& scene,
                                       const Estimator& estimator, const ParameterSet& values,
                                       ViewSelection views, const Progress& progress);

/// The head of a Markdown table of such errors, a row, and for each method the geometric mean of
/// the ratios and the largest.
[[nodiscard]] std::string twice_head();
[[nodiscard]] std::string twice_row(const TwiceRange& errors);
[[nodiscard]] std::string twice_summary(const std::vector<TwiceRange>& errors);

}  // namespace episcope::accuracy
