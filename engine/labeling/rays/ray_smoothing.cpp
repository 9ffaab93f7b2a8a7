// SPDX-License-Identifier: BSD-3-Clause
#include "engine/labeling/rays/ray_smoothing.h"

#include "engine/labeling/rays/device_labeling.h"
#include "engine/labeling/rays/ray_vote.h"
#include "engine/labeling/rays/solve_views.h"

namespace episcope {
namespace {

// Rounds of votes. The second makes labels agree that the first one has changed.
constexpr int kVotes = 2;

RayColors colors_of(const RayLabelingInput& input, const Progress& progress) {
  if (input.light_field == nullptr) return {};
  return {*input.light_field, input.probabilities->grid, input.probabilities->first, progress};
}

ViewProblems problems_of(const RayLabelingInput& input, const RayLabelingParameters& parameters,
                         TrackViews others, const Progress& progress) {
  const auto fill = [others](ViewProblem& problem, ViewIndex view, const Progress& part) {
    problem.fill_tracks(view, others, part);
  };
  return {input, parameters, colors_of(input, progress.part(0, 0)), fill};
}

void vote(const RayLabelingInput& input, const RayColors& colors, const Progress& progress,
          RayLabeling& result) {
  const RayVotes votes{static_cast<int>(input.probabilities->ids.size()), *input.disparity, colors};
  progress.step("rays");
  const ViewStack<std::int32_t> first =
      vote_along_rays(result.labels, votes, progress.part(0, 0.9));
  result.labels = vote_again_along_rays(result.labels, first, votes, progress.part(0.9, 1));
}

}  // namespace

RayLabeling smooth_rays(const RayLabelingInput& input, const RayLabelingParameters& parameters,
                        const Progress& progress) {
  if (is_for_device(input, parameters)) {
    const RayColors colors = colors_of(input, progress.part(0, 0));
    return label_on_device(input, parameters, {&colors, kVotes}, progress);
  }
  const ViewProblems problems = problems_of(input, parameters, TrackViews::Near, progress);
  RayLabeling result = solve_views(problems, progress.part(0, 0.9));
  vote(input, problems.colors, progress.part(0.9, 1), result);
  replace_layers_by_ids(input.probabilities->ids, result);
  return result;
}

RayLabeling smooth_rays_of_view(const RayLabelingInput& input, ViewIndex view,
                                const RayLabelingParameters& parameters, const Progress& progress) {
  const ViewProblems problems = problems_of(input, parameters, TrackViews::All, progress);
  RayLabeling result = solve_view(problems, view, progress);
  replace_layers_by_ids(input.probabilities->ids, result);
  return result;
}

}  // namespace episcope
