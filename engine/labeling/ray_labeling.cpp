// SPDX-License-Identifier: BSD-3-Clause
#include "engine/labeling/ray_labeling.h"

#include "engine/core/error.h"
#include "engine/core/parallel.h"
#include "engine/labeling/boundary_weights.h"
#include "engine/labeling/label_costs.h"
#include "engine/solvers/simplex_labeling.h"

#include <algorithm>
#include <cmath>
#include <memory>

namespace episcope {
namespace {

void check_input(const RayLabelingInput& input, LabelCoupling coupling,
                 const RayLabelingParameters& parameters) {
  if (input.probabilities == nullptr || input.probabilities->empty()) {
    throw InvalidInput("labels need probabilities of at least one view; train a classifier first");
  }
  if (coupling == LabelCoupling::Rays && (input.disparity == nullptr || input.disparity->empty())) {
    throw InvalidInput(
        "labels that agree along rays need a disparity map of every view; "
        "estimate one first, or regularise each view alone");
  }
  if (!(parameters.floor > 0 && parameters.floor <= 1)) {
    throw InvalidInput("the least probability of a label must be above 0 and at most 1");
  }
}

ViewIndex view_at(const LabelProbabilities& probabilities, int i) {
  return {probabilities.first.v + i / probabilities.grid.u,
          probabilities.first.u + i % probabilities.grid.u};
}

Image<float> weights_of(const RayLabelingInput& input, ViewIndex view) {
  if (input.edges == nullptr || input.edges->empty() || !input.edges->contains(view)) return {};
  return boundary_weights(input.edges->view(view));
}

// Everything that one problem on one view needs, for many views of one size.
class ViewProblem {
 public:
  explicit ViewProblem(const ProbabilityMap& like)
      : solver(like.height(), like.layers(), like.width()),
        costs(like.height(), like.layers(), like.width()),
        labels(like.height(), like.width()) {}

  void fill(const RayLabelingInput& input, ViewIndex view, LabelCoupling coupling,
            const CostTable& table, const Progress& progress) {
    if (coupling == LabelCoupling::Rays) {
      fill_track_costs(*input.probabilities, *input.disparity, view, table, progress, costs.view());
    } else {
      fill_costs(input.probabilities->view(view).view(), table, costs.view());
    }
  }
  SimplexResult solve(const RayLabelingInput& input, ViewIndex view,
                      const RayLabelingParameters& parameters, const Progress& progress) {
    const Image<float> weights = weights_of(input, view);
    SimplexOptions options;
    options.gap = parameters.gap;
    options.max_iterations = parameters.max_iterations;
    return solver.solve({costs.view(), weights, parameters.smoothness}, options, progress,
                        labels.view());
  }
  void write(const std::vector<std::int32_t>& ids, ImageView<std::int32_t> to) const {
    for (int y = 0; y < to.height; ++y) {
      std::transform(labels.row(y), labels.row(y) + to.width, to.row(y),
                     [&ids](int layer) { return ids[layer]; });
    }
  }

  SimplexSolver solver;
  Volume<float> costs;
  Image<int> labels;
};

void add(const SimplexResult& part, RayLabeling& result) {
  result.energy += part.energy;
  result.bound += part.bound;
  result.iterations = std::max(result.iterations, part.iterations);
}

void label_each_ray(const RayLabelingInput& input, const Progress& progress, RayLabeling& result) {
  const LabelProbabilities& p = *input.probabilities;
  parallel_for(p.grid.count(), progress, [&](int i) {
    const auto labels = most_probable_labels(p.views[i].view(), p.ids);
    std::copy(labels.begin(), labels.end(), result.labels.view(view_at(p, i)).data);
  });
}

void label_each_view(const RayLabelingInput& input, LabelCoupling coupling,
                     const RayLabelingParameters& parameters, const Progress& progress,
                     RayLabeling& result) {
  const LabelProbabilities& p = *input.probabilities;
  const CostTable table = cost_table(parameters.floor);
  std::vector<SimplexResult> parts(p.views.size());
  progress.step("views");
  // Whole views side by side: threads that share a view wait for each other at every iteration.
  parallel_for_workers(p.grid.count(), progress, [&]() -> std::function<void(int)> {
    auto problem = std::make_shared<ViewProblem>(p.views[0]);
    return [&, problem](int i) {
      fill_costs(p.views[i].view(), table, problem->costs.view());
      parts[i] =
          problem->solve(input, view_at(p, i), parameters, progress.part(0, 0).on_one_thread());
      problem->write(p.ids, result.labels.view(view_at(p, i)));
    };
  });
  for (const auto& part : parts) add(part, result);
}

}  // namespace

double RayLabeling::relative_gap() const {
  return energy == bound ? 0 : (energy - bound) / std::abs(energy);
}

RayLabeling label_rays(const RayLabelingInput& input, LabelCoupling coupling,
                       const RayLabelingParameters& parameters, const Progress& progress) {
  check_input(input, coupling, parameters);
  const LabelProbabilities& p = *input.probabilities;
  RayLabeling result;
  result.labels =
      ViewStack<std::int32_t>(p.grid, p.views[0].height(), p.views[0].width(), 1, p.first);
  if (coupling == LabelCoupling::None) {
    label_each_ray(input, progress, result);
  } else {
    label_each_view(input, coupling, parameters, progress, result);
  }
  return result;
}

RayLabeling label_view(const RayLabelingInput& input, ViewIndex view, LabelCoupling coupling,
                       const RayLabelingParameters& parameters, const Progress& progress) {
  check_input(input, coupling, parameters);
  const LabelProbabilities& p = *input.probabilities;
  if (!p.contains(view)) {
    throw InvalidInput("there are no label probabilities of view " + view_text(view));
  }
  const ProbabilityMap& own = p.view(view);
  RayLabeling result;
  result.labels = ViewStack<std::int32_t>({1, 1}, own.height(), own.width(), 1, view);
  const auto out = result.labels.view(view);
  if (coupling == LabelCoupling::None) {
    const auto labels = most_probable_labels(own.view(), p.ids);
    std::copy(labels.begin(), labels.end(), out.data);
    return result;
  }
  ViewProblem problem(own);
  const CostTable table = cost_table(parameters.floor);
  if (coupling == LabelCoupling::Rays) {
    fill_track_costs(p, *input.disparity, view, table, progress.part(0, 0.2), problem.costs.view());
  } else {
    fill_costs(own.view(), table, problem.costs.view());
  }
  add(problem.solve(input, view, parameters, progress.part(0.2, 1)), result);
  problem.write(p.ids, out);
  return result;
}

}  // namespace episcope
