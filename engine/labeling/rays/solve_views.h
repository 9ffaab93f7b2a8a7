// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/labeling/rays/view_problem.h"

#include <functional>
#include <vector>

namespace episcope {

/// Views of one row of the grid, numbers [begin, end), that are solved one after the other.
struct ViewChain {
  int begin = 0, end = 0;
};
[[nodiscard]] std::vector<ViewChain> view_chains(GridShape grid);

/// The separate problems of the views, and how the costs of a view get into its problem. Borrows
/// the input and the parameters.
struct ViewProblems {
  const RayLabelingInput& input;
  const RayLabelingParameters& parameters;
  RayColors colors;
  std::function<void(ViewProblem&, ViewIndex, const Progress&)> fill;
};

/// Solves the problems of all views that have probabilities, to a gap of
/// `parameters.gap_all_views`, in chains along rows of the grid: each view starts from the result
/// of its neighbour, moved along the disparities, if there are any. Labels are layers of the
/// probabilities, 0 … L − 1. Throws Cancelled.
[[nodiscard]] RayLabeling solve_views(const ViewProblems& problems, const Progress& progress);

/// Solves the problem of one view, to a gap of `parameters.gap`.
[[nodiscard]] RayLabeling solve_view(const ViewProblems& problems, ViewIndex view,
                                     const Progress& progress);

/// Replaces layers by their ids.
void replace_layers_by_ids(const std::vector<std::int32_t>& ids, RayLabeling& labeling);

}  // namespace episcope
