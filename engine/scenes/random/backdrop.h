// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/scenes/random/plan.h"

#include <optional>

namespace episcope::scenes {

/// What lies behind all things: a wall, and maybe ground that rises towards it.
class Backdrop {
 public:
  /// Disparities stay in the range of the plan as far as views of a 9×9 grid see.
  Backdrop(const Stage& stage, const Plan& plan, Draw draw);

  /// Disparity at a pixel of the centre view.
  [[nodiscard]] double disparity_at(double x, double y) const;
  /// Row above which no ground is seen; the height of the image if there is none.
  [[nodiscard]] double horizon() const { return horizon_; }

  /// Adds the surfaces with labels from 1 on; returns the next label.
  int build(Model& model, const Plan& plan, Draw draw) const;

 private:
  [[nodiscard]] double on(const DisparityPlane& plane, double x, double y) const;

  const Stage& stage_;
  DisparityPlane wall_;
  std::optional<DisparityPlane> ground_;
  double horizon_ = 0;
};

}  // namespace episcope::scenes
