// SPDX-License-Identifier: BSD-3-Clause
#include "engine/labeling/rays/no_smoothing.h"

#include "engine/core/parallel/parallel.h"

#include <algorithm>

namespace episcope {
namespace {

void label_into(const LabelProbabilities& p, ViewIndex view, RayLabeling& result) {
  const auto labels = most_probable_labels(p.view(view).view(), p.ids);
  std::copy(labels.begin(), labels.end(), result.labels.view(view).data);
}

}  // namespace

RayLabeling most_probable_labels_of_all(const RayLabelingInput& input, const RayLabelingParameters&,
                                        const Progress& progress) {
  const LabelProbabilities& p = *input.probabilities;
  RayLabeling result = unlabeled(p);
  parallel_for(p.grid.count(), progress, [&](int i) { label_into(p, p.view_at(i), result); });
  return result;
}

RayLabeling most_probable_labels_of_view(const RayLabelingInput& input, ViewIndex view,
                                         const RayLabelingParameters&, const Progress&) {
  RayLabeling result = unlabeled(*input.probabilities, view);
  label_into(*input.probabilities, view, result);
  return result;
}

}  // namespace episcope
