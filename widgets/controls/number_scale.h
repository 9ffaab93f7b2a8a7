// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/parameter/parameter.h"

namespace episcope {

/// How a slider of `steps` + 1 positions covers the domain of a number: evenly, or in powers where
/// the description says so (an interval that touches 0 is covered by powers of 1 + value/scale).
class NumberScale {
 public:
  NumberScale(double min, double max, bool logarithmic, int steps);
  explicit NumberScale(const ParameterDescription& description);

  [[nodiscard]] int steps() const { return steps_; }
  /// Position of a value clamped to the domain.
  [[nodiscard]] int position(double value) const;
  /// The ends of the slider give the ends of the domain exactly.
  [[nodiscard]] double value(int position) const;
  /// Decimals that show a tenth of the smallest step that matters.
  [[nodiscard]] int decimals() const;

 private:
  double min_;
  double max_;
  bool logarithmic_;
  int steps_;
  double offset_ = 0;  ///< Added before the logarithm is taken.
};

}  // namespace episcope
