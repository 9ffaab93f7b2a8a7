// SPDX-License-Identifier: BSD-3-Clause
#include "engine/labeling/rays/kept_solver.h"

namespace episcope {

double KeptSolver::bytes(double pixels, int labels) {
  return (8 * 4.0 / 3 + 1.0 / 3) * sizeof(float) * pixels * labels;
}

bool KeptSolver::prepare(const LabelProbabilities& probabilities, ViewIndex view) {
  const ProbabilityMap& map = probabilities.view(view);
  if (solver_ && view == view_ && map.height() == height_ && map.width() == width_ &&
      probabilities.ids == ids_) {
    return true;
  }
  solver_.reset();
  solver_.emplace(map.height(), map.layers(), map.width());
  view_ = view;
  height_ = map.height();
  width_ = map.width();
  ids_ = probabilities.ids;
  return false;
}

}  // namespace episcope
