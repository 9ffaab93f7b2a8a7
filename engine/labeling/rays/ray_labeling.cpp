// SPDX-License-Identifier: BSD-3-Clause
#include "engine/labeling/rays/ray_labeling.h"

#include "engine/core/error.h"
#include "engine/core/parallel/parallel.h"
#include "engine/labeling/rays/ray_vote.h"
#include "engine/labeling/rays/view_problem.h"
#include "engine/solvers/simplex/pair_labels.h"

#include <algorithm>
#include <memory>

namespace episcope {
namespace {

// The second makes labels agree that the first one has changed.
constexpr int kVotes = 2;

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

void check_samples(const RayLabelingInput& input) {
  const LightField* const lf = input.light_field;
  const LabelProbabilities& p = *input.probabilities;
  if (lf == nullptr || (lf->height() == p.views[0].height() && lf->width() == p.views[0].width() &&
                        covers(lf->grid(), {0, 0}, p))) {
    return;
  }
  throw InvalidInput("labels that agree along rays need the light field that they are of");
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
    check_samples(input);
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

// Views of one row of the grid that are solved one after the other, each beginning where the last
// ended, and how many such chains there are at least, for as many threads.
constexpr int kLongestChain = 9;
constexpr int kLeastChains = 8;

struct Chain {
  int begin = 0, end = 0;  // of the views' numbers
};

std::vector<Chain> chains_of(GridShape grid) {
  const int length = std::clamp(grid.count() / kLeastChains, 1, kLongestChain);
  std::vector<Chain> chains;
  for (int v = 0; v < grid.v; ++v) {
    for (int u = 0; u < grid.u; u += length) {
      chains.push_back({v * grid.u + u, v * grid.u + std::min(u + length, grid.u)});
    }
  }
  return chains;
}

void label_each_view(const RayLabelingInput& input, bool is_joint, const RayColors& colors,
                     const RayLabelingParameters& parameters, const Progress& progress,
                     RayLabeling& result) {
  const LabelProbabilities& p = *input.probabilities;
  const std::vector<Chain> chains = chains_of(p.grid);
  std::vector<SimplexResult> parts(p.views.size());
  progress.step("views");
  // Whole views side by side: threads that share a view wait for each other at every iteration.
  const Progress alone = progress.part(0, 0).on_one_thread();
  parallel_for_workers(static_cast<int>(chains.size()), progress, [&]() {
    auto problem = std::make_shared<ViewProblem>(input, parameters, colors);
    return [&, problem](int k) {
      ViewProblem::Task task{{}, parameters.gap_of_many, {}};
      for (int i = chains[k].begin; i < chains[k].end; ++i) {
        task.view = p.view_at(i);
        if (is_joint) {
          problem->fill_tracks(task.view, TrackViews::Near, alone);
        } else {
          problem->fill_own(task.view);
        }
        parts[i] = problem->solve(task, alone, result.labels.view(task.view));
        task.last = task.view;
      }
    };
  });
  for (const auto& part : parts) add(part, result);
}

RayColors colors_of(const RayLabelingInput& input, const Progress& progress) {
  if (input.light_field == nullptr) return {};
  return {*input.light_field, input.probabilities->grid, input.probabilities->first, progress};
}

void vote(const RayLabelingInput& input, const RayColors& colors, const Progress& progress,
          RayLabeling& result) {
  const LabelProbabilities& p = *input.probabilities;
  progress.step("rays");
  for (int round = 0; round < kVotes; ++round) {
    result.labels =
        vote_along_rays(result.labels, static_cast<int>(p.ids.size()), *input.disparity, colors,
                        progress.part(round / double{kVotes}, (round + 1.0) / kVotes));
  }
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
  const bool is_joint = coupling == LabelCoupling::Rays;
  const RayColors colors = is_joint ? colors_of(input, progress.part(0, 0)) : RayColors();
  label_each_view(input, is_joint, colors, parameters, progress.part(0, is_joint ? 0.9 : 1),
                  result);
  if (is_joint) vote(input, colors, progress.part(0.9, 1), result);
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
  const bool is_joint = coupling == LabelCoupling::Rays;
  const RayColors colors = is_joint ? colors_of(input, progress.part(0, 0)) : RayColors();
  ViewProblem problem(input, parameters, colors);
  if (is_joint) {
    problem.fill_tracks(view, TrackViews::All, progress.part(0, 0.2));
  } else {
    problem.fill_own(view);
  }
  add(problem.solve({view, parameters.gap, {}}, progress.part(0.2, 1), out), result);
  name_labels(p.ids, result.labels);
  return result;
}

}  // namespace episcope
