// SPDX-License-Identifier: BSD-3-Clause
#include "engine/labeling/view_problem.h"

#include "engine/labeling/boundary_weights.h"

namespace episcope {
ViewProblem::ViewProblem(const RayLabelingInput& input, const RayLabelingParameters& parameters)
    : input_(input),
      parameters_(parameters),
      table_(cost_table(parameters.floor)),
      solver_(input.probabilities->views[0].height(), input.probabilities->views[0].layers(),
              input.probabilities->views[0].width()),
      costs_(input.probabilities->views[0].height(), input.probabilities->views[0].layers(),
             input.probabilities->views[0].width()) {}

Image<float> ViewProblem::weights(ViewIndex view) const {
  if (input_.edges == nullptr || input_.edges->empty() || !input_.edges->contains(view)) return {};
  return boundary_weights(input_.edges->view(view));
}

void ViewProblem::fill_own(ViewIndex view) {
  fill_costs(input_.probabilities->view(view).view(), table_, costs_.view());
}

void ViewProblem::fill_tracks(ViewIndex view, ImageView<const std::int32_t> known,
                              const Progress& progress) {
  fill_track_costs({*input_.probabilities, *input_.disparity, view, known}, table_, progress,
                   costs_.view());
  if (!known.empty()) keep(known);
}

void ViewProblem::keep(ImageView<const std::int32_t> known) {
  // More than all boundaries of a pixel together: no other label can pay.
  const auto prohibitive = static_cast<float>(4 * parameters_.smoothness + 1);
  const auto costs = costs_.view();
  for (int y = 0; y < costs.height; ++y) {
    for (int layer = 0; layer < costs.layers; ++layer) {
      float* const row = costs.row(y, layer);
      for (int x = 0; x < costs.width; ++x) {
        const std::int32_t label = known.at(y, x);
        if (label >= 0) row[x] = label == layer ? 0 : prohibitive;
      }
    }
  }
}

SimplexResult ViewProblem::solve(ViewIndex view, const Progress& progress,
                                 ImageView<std::int32_t> labels) {
  const Image<float> g = weights(view);
  SimplexOptions options;
  options.gap = parameters_.gap;
  options.max_iterations = parameters_.max_iterations;
  return solver_.solve({costs_.view(), g, parameters_.smoothness}, options, progress, labels);
}

}  // namespace episcope
