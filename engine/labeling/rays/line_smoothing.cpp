// SPDX-License-Identifier: BSD-3-Clause
#include "engine/labeling/rays/line_smoothing.h"

#include "engine/core/parallel/parallel.h"
#include "engine/labeling/rays/boundary_weights.h"
#include "engine/labeling/rays/label_costs.h"
#include "engine/labeling/rays/ray_lines.h"
#include "engine/labeling/rays/solve_views.h"
#include "engine/solvers/linked/linked_labeling.h"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

namespace episcope {
namespace {

using LinesOfView = std::array<RayLines, kLinkKinds>;

// The next view to the right and below.
constexpr ViewIndex kSteps[kLinkKinds] = {{0, 1}, {1, 0}};

std::vector<LinesOfView> lines_of(const RayLabelingInput& input, const Progress& progress) {
  const LabelProbabilities& p = *input.probabilities;
  const RayColors colors = input.light_field == nullptr ? RayColors()
                                                        : RayColors(*input.light_field, p.grid,
                                                                    p.first, progress.part(0, 0));
  const ViewIndex middle{p.first.v + p.grid.v / 2, p.first.u + p.grid.u / 2};
  std::vector<LinesOfView> lines(p.views.size());
  parallel_for(p.grid.count(), progress, [&](int i) {
    const ViewIndex view = p.view_at(i);
    for (int kind = 0; kind < kLinkKinds; ++kind) {
      const ViewIndex next{view.v + kSteps[kind].v, view.u + kSteps[kind].u};
      if (!p.contains(next)) continue;
      lines[i][kind] = find_ray_lines({*input.disparity, colors, middle}, view, next, progress);
    }
  });
  return lines;
}

std::vector<Image<float>> weights_of(const RayLabelingInput& input, const Progress& progress) {
  const LabelProbabilities& p = *input.probabilities;
  std::vector<Image<float>> weights(p.views.size());
  if (input.edges == nullptr || input.edges->empty()) return weights;
  parallel_for(p.grid.count(), progress, [&](int i) {
    if (input.edges->contains(p.view_at(i))) {
      weights[i] = boundary_weights(input.edges->view(p.view_at(i)));
    }
  });
  return weights;
}

// The problem, and what it borrows.
struct JointProblem {
  JointProblem(const RayLabelingInput& input, const RayLabelingParameters& parameters,
               const Progress& progress)
      : lines(lines_of(input, progress.part(0, 0.7))),
        weights(weights_of(input, progress.part(0.7, 1))) {
    state(input, parameters);
  }
  JointProblem(const JointProblem&) = delete;
  JointProblem& operator=(const JointProblem&) = delete;

  std::vector<LinesOfView> lines;
  std::vector<Image<float>> weights;
  LinkedProblem problem;

 private:
  void state(const RayLabelingInput& input, const RayLabelingParameters& parameters);
};

void JointProblem::state(const RayLabelingInput& input, const RayLabelingParameters& parameters) {
  const LabelProbabilities& p = *input.probabilities;
  problem.table = cost_table(parameters.floor);
  problem.smoothness = parameters.smoothness;
  problem.coherence = parameters.coherence;
  for (int i = 0; i < p.grid.count(); ++i) {
    LinkedImage& image = problem.images.emplace_back();
    image.codes = p.views[i].view();
    if (!weights[i].empty()) image.g = weights[i];
    for (int kind = 0; kind < kLinkKinds; ++kind) {
      const RayLines& of_kind = lines[i][kind];
      if (of_kind.target.empty()) continue;
      const int to = i + kSteps[kind].v * p.grid.u + kSteps[kind].u;
      image.links[kind] = {to, of_kind.target, of_kind.weight};
    }
  }
}

// Layers, not ids.
RayLabeling solve(const RayLabelingInput& input, const RayLabelingParameters& parameters,
                  double gap, const Progress& progress) {
  progress.step("lines");
  const JointProblem joint(input, parameters, progress.part(0, 0.03));
  LinkedOptions options;
  options.gap = gap;
  options.max_iterations = parameters.max_iterations;
  RayLabeling result = unlabeled(*input.probabilities);
  std::vector<ImageView<int>> labels;
  for (int i = 0; i < input.probabilities->grid.count(); ++i) {
    labels.push_back(result.labels.view(input.probabilities->view_at(i)));
  }
  progress.step("views");
  const LinkedResult solved =
      solve_linked_labeling(joint.problem, options, progress.part(0.03, 1), labels);
  result.energy = solved.energy;
  result.bound = solved.bound;
  result.iterations = solved.iterations;
  return result;
}

}  // namespace

RayLabeling smooth_lines(const RayLabelingInput& input, const RayLabelingParameters& parameters,
                         const Progress& progress) {
  RayLabeling result = solve(input, parameters, parameters.gap_joint, progress);
  replace_layers_by_ids(input.probabilities->ids, result);
  return result;
}

RayLabeling smooth_lines_of_view(const RayLabelingInput& input, ViewIndex view,
                                 const RayLabelingParameters& parameters,
                                 const Progress& progress) {
  const RayLabeling all = solve(input, parameters, parameters.gap, progress);
  RayLabeling result = unlabeled(*input.probabilities, view);
  result.energy = all.energy;
  result.bound = all.bound;
  result.iterations = all.iterations;
  const ImageView<const std::int32_t> wanted = all.labels.view(view);
  std::copy_n(wanted.data, all.labels.view_size(), result.labels.view(view).data);
  replace_layers_by_ids(input.probabilities->ids, result);
  return result;
}

double line_energy(const RayLabelingInput& input, const RayLabelingParameters& parameters,
                   const ViewStack<std::int32_t>& labels) {
  const LabelProbabilities& p = *input.probabilities;
  ViewStack<std::int32_t> layers = labels.clone();
  std::for_each(layers.data(), layers.data() + layers.size(), [&p](std::int32_t& label) {
    label = static_cast<std::int32_t>(std::ranges::lower_bound(p.ids, label) - p.ids.begin());
  });
  std::vector<ImageView<const int>> views;
  for (int i = 0; i < p.grid.count(); ++i) {
    views.push_back(std::as_const(layers).view(p.view_at(i)));
  }
  return linked_energy(JointProblem(input, parameters, Progress()).problem, views);
}

}  // namespace episcope
