// SPDX-License-Identifier: BSD-3-Clause
#include "engine/labeling/rays/solve_views.h"

#include "engine/core/parallel/parallel.h"

#include <algorithm>

namespace episcope {
namespace {

// Views of one row of the grid that are solved one after the other, each beginning where the last
// ended, and how many such chains there are at least, for as many threads.
constexpr int kLongestChain = 9;
constexpr int kMinChains = 8;

void add(const SimplexResult& part, RayLabeling& result) {
  result.energy += part.energy;
  result.bound += part.bound;
  result.iterations = std::max(result.iterations, part.iterations);
}

}  // namespace

std::vector<ViewChain> view_chains(GridShape grid) {
  std::vector<ViewChain> chains;
  for (int v = 0; v < grid.v; ++v) {
    int length = std::clamp(grid.count() / kMinChains, 1, kLongestChain);
    // An odd number of long chains would leave one of two threads without work.
    if (v == grid.v - 1) length = (length + 1) / 2;
    for (int u = 0; u < grid.u; u += length) {
      chains.push_back({v * grid.u + u, v * grid.u + std::min(u + length, grid.u)});
    }
  }
  return chains;
}

RayLabeling solve_views(const ViewProblems& problems, const Progress& progress) {
  const LabelProbabilities& p = *problems.input.probabilities;
  RayLabeling result = unlabeled(p);
  const std::vector<ViewChain> chains = view_chains(p.grid);
  std::vector<SimplexResult> parts(p.views.size());
  progress.step("views");
  // Whole views side by side: threads that share a view wait for each other at every iteration.
  const Progress alone = progress.part(0, 0).on_one_thread();
  parallel_for_workers(static_cast<int>(chains.size()), progress, [&] {
    return [&, problem = ViewProblem(problems.input, problems.parameters, problems.colors)](
               int k) mutable {
      ViewProblem::Task task{{}, problems.parameters.gap_all_views, {}};
      for (int i = chains[k].begin; i < chains[k].end; ++i) {
        task.view = p.view_at(i);
        problems.fill(problem, task.view, alone);
        parts[i] = problem.solve(task, alone, result.labels.view(task.view));
        task.last = task.view;
      }
    };
  });
  for (const auto& part : parts) add(part, result);
  return result;
}

RayLabeling solve_view(const ViewProblems& problems, ViewIndex view, const Progress& progress) {
  RayLabeling result = unlabeled(*problems.input.probabilities, view);
  ViewProblem problem(problems.input, problems.parameters, problems.colors);
  problems.fill(problem, view, progress.part(0, 0.2));
  const ViewProblem::Task task{view, problems.parameters.gap, {}};
  add(problem.solve(task, progress.part(0.2, 1), result.labels.view(view)), result);
  return result;
}

void replace_layers_by_ids(const std::vector<std::int32_t>& ids, RayLabeling& labeling) {
  ViewStack<std::int32_t>& labels = labeling.labels;
  std::for_each(labels.data(), labels.data() + labels.size(),
                [&ids](std::int32_t& label) { label = ids[label]; });
}

}  // namespace episcope
