// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/light_field/light_field.h"
#include "engine/core/parallel/progress.h"

#include <optional>
#include <vector>

namespace episcope {

/// How often each disparity is seen in the centre view, by the structure tensor on some rows and
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
  /// counts even where few of its pixels are coherent. Half of the 0.2 px is the margin. None if
  /// too few cells are left.
  [[nodiscard]] std::optional<Interval> ends(double tail) const;

 private:
  double limit_;
  std::vector<double> cells_;
  double total_ = 0;
};

}  // namespace episcope
