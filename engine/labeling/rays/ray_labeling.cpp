// SPDX-License-Identifier: BSD-3-Clause
#include "engine/labeling/rays/ray_labeling.h"

#include "engine/solvers/simplex/pair_labels.h"

namespace episcope {

double RayLabeling::relative_gap() const {
  return labeling_gap(energy, bound);
}

RayLabeling unlabeled(const LabelProbabilities& p) {
  RayLabeling result;
  result.labels =
      ViewStack<std::int32_t>(p.grid, p.views[0].height(), p.views[0].width(), 1, p.first);
  return result;
}

RayLabeling unlabeled(const LabelProbabilities& p, ViewIndex view) {
  RayLabeling result;
  result.labels =
      ViewStack<std::int32_t>({1, 1}, p.view(view).height(), p.view(view).width(), 1, view);
  return result;
}

}  // namespace episcope
