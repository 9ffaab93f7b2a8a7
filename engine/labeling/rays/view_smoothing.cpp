// SPDX-License-Identifier: BSD-3-Clause
#include "engine/labeling/rays/view_smoothing.h"

#include "engine/labeling/rays/device_labeling.h"
#include "engine/labeling/rays/solve_views.h"

namespace episcope {
namespace {

ViewProblems problems_of(const RayLabelingInput& input, const RayLabelingParameters& parameters) {
  const auto fill = [](ViewProblem& problem, ViewIndex view, const Progress&) {
    problem.fill_own(view);
  };
  return {input, parameters, {}, fill};
}

}  // namespace

RayLabeling smooth_views(const RayLabelingInput& input, const RayLabelingParameters& parameters,
                         const Progress& progress) {
  if (is_for_device(input, parameters)) return label_on_device(input, parameters, {}, progress);
  RayLabeling result = solve_views(problems_of(input, parameters), progress);
  replace_layers_by_ids(input.probabilities->ids, result);
  return result;
}

RayLabeling smooth_view(const RayLabelingInput& input, ViewIndex view,
                        const RayLabelingParameters& parameters, const Progress& progress) {
  RayLabeling result = solve_view(problems_of(input, parameters), view, progress);
  replace_layers_by_ids(input.probabilities->ids, result);
  return result;
}

}  // namespace episcope
