// SPDX-License-Identifier: BSD-3-Clause
#include "engine/labeling/ray_labeling.h"

#include "engine/core/error.h"
#include "engine/core/parallel.h"
#include "engine/labeling/ray_space.h"
#include "engine/labeling/view_problem.h"
#include "engine/solvers/pair_labels.h"

#include <algorithm>
#include <memory>

namespace episcope {
namespace {

bool covers(const GridShape& grid, ViewIndex first, const LabelProbabilities& p) {
  const ViewIndex begin{p.first.v - first.v, p.first.u - first.u};
  return grid.contains(begin) && grid.contains({begin.v + p.grid.v - 1, begin.u + p.grid.u - 1});
}

template <class T>
void check_maps(const ViewStack<T>& maps, const LabelProbabilities& p, const char* what) {
  const ProbabilityMap& view = p.views[0];
  if (maps.height() == view.height() && maps.width() == view.width() &&
      covers(maps.grid(), maps.first(), p)) {
    return;
  }
  throw InvalidInput("labels of " + std::to_string(p.grid.count()) + " views of " +
                     std::to_string(view.width()) + "×" + std::to_string(view.height()) +
                     " px need " + what + " of the same size in each of these views");
}

void check_input(const RayLabelingInput& input, LabelCoupling coupling,
                 const RayLabelingParameters& parameters) {
  if (input.probabilities == nullptr || input.probabilities->empty()) {
    throw InvalidInput("labels need probabilities of at least one view; train a classifier first");
  }
  if (coupling == LabelCoupling::Rays) {
    if (input.disparity == nullptr || input.disparity->empty()) {
      throw InvalidInput(
          "labels that agree along rays need a disparity map of every view; estimate one first, "
          "or regularise each view alone");
    }
    check_maps(input.disparity->disparity, *input.probabilities, "disparities");
  }
  if (input.edges != nullptr && !input.edges->empty()) {
    check_maps(*input.edges, *input.probabilities, "edges");
  }
  if (!(parameters.smoothness >= 0)) {
    throw InvalidInput("the smoothness of labels must not be negative");
  }
  if (!(parameters.floor > 0 && parameters.floor <= 1)) {
    throw InvalidInput("the least probability of a label must be above 0 and at most 1");
  }
}

void name_labels(const std::vector<std::int32_t>& ids, ViewStack<std::int32_t>& labels) {
  std::for_each(labels.data(), labels.data() + labels.size(),
                [&ids](std::int32_t& label) { label = ids[label]; });
}

void add(const SimplexResult& part, RayLabeling& result) {
  result.energy += part.energy;
  result.bound += part.bound;
  result.iterations = std::max(result.iterations, part.iterations);
}

void label_each_ray(const RayLabelingInput& input, const Progress& progress, RayLabeling& result) {
  const LabelProbabilities& p = *input.probabilities;
  parallel_for(p.grid.count(), progress, [&](int i) {
    const auto labels = most_probable_labels(p.views[i].view(), p.ids);
    std::copy(labels.begin(), labels.end(), result.labels.view(p.view_at(i)).data);
  });
}

void label_each_view(const RayLabelingInput& input, const RayLabelingParameters& parameters,
                     const Progress& progress, RayLabeling& result) {
  const LabelProbabilities& p = *input.probabilities;
  std::vector<SimplexResult> parts(p.views.size());
  progress.step("views");
  // Whole views side by side: threads that share a view wait for each other at every iteration.
  parallel_for_workers(p.grid.count(), progress, [&]() -> std::function<void(int)> {
    auto problem = std::make_shared<ViewProblem>(input, parameters);
    return [&, problem](int i) {
      const ViewIndex view = p.view_at(i);
      problem->fill_own(view);
      parts[i] =
          problem->solve(view, progress.part(0, 0).on_one_thread(), result.labels.view(view));
    };
  });
  for (const auto& part : parts) add(part, result);
}

}  // namespace

double RayLabeling::relative_gap() const {
  return labeling_gap(energy, bound);
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
    return result;
  }
  if (coupling == LabelCoupling::Views) {
    label_each_view(input, parameters, progress, result);
  } else {
    label_ray_space(input, parameters, progress, result);
  }
  name_labels(p.ids, result.labels);
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
  ViewProblem problem(input, parameters);
  if (coupling == LabelCoupling::Rays) {
    problem.fill_tracks(view, {}, progress.part(0, 0.2));
  } else {
    problem.fill_own(view);
  }
  add(problem.solve(view, progress.part(0.2, 1), out), result);
  name_labels(p.ids, result.labels);
  return result;
}

}  // namespace episcope
