// SPDX-License-Identifier: BSD-3-Clause
#include "engine/labeling/rays/view_problem.h"

#include "engine/labeling/rays/boundary_weights.h"
#include "engine/labeling/rays/ray_targets.h"

namespace episcope {

ViewProblem::ViewProblem(const RayLabelingInput& input, const RayLabelingParameters& parameters,
                         const RayColors& colors)
    : input_(input),
      parameters_(parameters),
      colors_(colors),
      table_(cost_table(parameters.floor)),
      costs_(input.probabilities->views[0].height(), input.probabilities->views[0].layers(),
             input.probabilities->views[0].width()) {}

Image<float> ViewProblem::weights(ViewIndex view) const {
  if (input_.edges == nullptr || input_.edges->empty() || !input_.edges->contains(view)) return {};
  return boundary_weights(input_.edges->view(view));
}

void ViewProblem::fill_own(ViewIndex view) {
  fill_costs(input_.probabilities->view(view).view(), table_, costs_.view());
}

void ViewProblem::fill_tracks(ViewIndex view, TrackViews others, const Progress& progress) {
  fill_track_costs({*input_.probabilities, *input_.disparity, view, others, &colors_}, table_,
                   progress, costs_.view());
}

// Where the pixels of `view` were in `last`; empty if that is not known.
ImageView<const std::int32_t> ViewProblem::places_in(ViewIndex last, ViewIndex view) {
  const DisparityField* const disparity = input_.disparity;
  if (disparity == nullptr || !disparity->contains(last) || !disparity->contains(view)) return {};
  const int height = costs_.view().height, width = costs_.view().width;
  if (disparity->disparity.height() != height || disparity->disparity.width() != width) return {};
  if (places_.empty()) places_ = Image<std::int32_t>(height, width);
  for (int y = 0; y < height; ++y) {
    find_ray_targets(disparity->view(view), disparity->view(last),
                     {last.v - view.v, last.u - view.u}, y, places_.row(y));
  }
  return places_;
}

SimplexResult ViewProblem::solve(const Task& task, const Progress& progress,
                                 ImageView<std::int32_t> labels) {
  const Image<float> g = weights(task.view);
  SimplexOptions options;
  options.gap = task.gap;
  options.max_iterations = parameters_.max_iterations;
  options.check_every = kGapCheckEvery;
  options.racing_iterations = kRacingIterations;
  const SimplexProblem problem{costs_.view(), g, parameters_.smoothness};
  if (KeptSolver* const kept = input_.kept) {
    options.goes_on = kept->prepare(*input_.probabilities, task.view);
    if (options.goes_on) options.racing_iterations = kRacingWhenGoingOn;
    return kept->solve(problem, options, progress, labels);
  }
  if (task.last) options.from_last = places_in(*task.last, task.view);
  return own_solver().solve(problem, options, progress, labels);
}

SimplexSolver& ViewProblem::own_solver() {
  if (!solver_) solver_.emplace(costs_.height(), costs_.layers(), costs_.width());
  return *solver_;
}

}  // namespace episcope
