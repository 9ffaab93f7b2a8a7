// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/progress.h"
#include "engine/cuda/ray_labels.h"
#include "engine/labeling/forest_kernel.h"
#include "engine/labeling/ray_labeling.h"
#include "engine/solvers/simplex_labeling.h"

#include <algorithm>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

namespace episcope {

/// Keeps the solver of one view between calls while the user paints. A stroke changes little, so
/// the next call needs few iterations from the last state. Labels of the last problems are kept
/// too, so that undoing a stroke restores the labels before it exactly.
class KeptSolver {
 public:
  /// Memory of the solver: 8 floats per pixel and label on each level, and the costs of all levels
  /// but the first.
  [[nodiscard]] static double bytes(double pixels, int labels);

  /// Prepares for the problem of `view`. Returns whether the solver continues from the last
  /// problem, which needs the same view, size and labels; otherwise it starts anew.
  bool prepare(const LabelProbabilities& probabilities, ViewIndex view);
  /// After `prepare`: returns the labels of an equal problem if one is kept, otherwise solves it as
  /// SimplexSolver::solve.
  SimplexResult solve(const SimplexProblem& problem, const SimplexOptions& options,
                      const Progress& progress, ImageView<int> labels);
  /// Frees all memory.
  void drop();

 private:
  struct Solved {
    std::uint64_t problem = 0;  // hash
    double gap = 0;
    SimplexResult result;
    std::vector<std::uint8_t> labels;
  };

  std::optional<SimplexSolver> solver_;
  std::deque<Solved> solved_;  // The newest last.
  ViewIndex view_;
  int height_ = 0, width_ = 0;
  std::vector<std::int32_t> ids_;
};

/// Options to solve one view afresh, to a relative duality gap of `gap`.
[[nodiscard]] SimplexOptions simplex_options(const RayLabelingParameters& parameters, double gap);

/// Adds energy and bound of a part to a sum, which takes the most iterations of its parts.
template <class Sum>
void add_part(const SimplexResult& part, Sum& sum) {
  sum.energy += part.energy;
  sum.bound += part.bound;
  sum.iterations = std::max(sum.iterations, part.iterations);
}

/// The labeling of one view as a problem of its own, and room to solve it for many views: costs of
/// its labels, weights of its boundaries, the solver. One object per solving thread.
class ViewProblem {
 public:
  /// Borrows the input. All views have the size of the first.
  ViewProblem(const RayLabelingInput& input, const RayLabelingParameters& parameters,
              const RayColors& colors);

  /// Costs of each ray by its own probabilities.
  void fill_own(ViewIndex view);
  /// Costs of each ray's track.
  void fill_tracks(ViewIndex view, TrackViews others, const Progress& progress);
  /// Solves with the costs last filled, to a relative duality gap of `gap`. `labels` become layers
  /// of the probabilities, 0 … L − 1. Begins where the problem of the view `last` ended, moved
  /// along the rays, if that was solved last and the disparities of both are known. With a kept
  /// solver, begins where that ended.
  struct Task {
    ViewIndex view;
    double gap = 0;
    std::optional<ViewIndex> last;
  };
  SimplexResult solve(const Task& task, const Progress& progress, ImageView<std::int32_t> labels);

 private:
  SimplexResult solve(const Task& task, const SimplexProblem& problem, const Progress& progress,
                      ImageView<std::int32_t> labels);
  [[nodiscard]] ImageView<const std::int32_t> places_in(ViewIndex last, ViewIndex view);
  [[nodiscard]] SimplexSolver& own_solver();

  const RayLabelingInput& input_;
  const RayLabelingParameters& parameters_;
  const RayColors& colors_;
  CostTable table_;
  std::optional<SimplexSolver> solver_;
  Volume<float> costs_;
  Image<std::int32_t> places_;
};

/// Views of one row of the grid, numbers [begin, end), that are solved one after the other.
struct ViewChain {
  int begin = 0, end = 0;
};

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
/// of its neighbor, moved along the disparities, if there are any. Labels are layers of the
/// probabilities, 0 … L − 1. Throws Cancelled.
[[nodiscard]] RayLabeling solve_views(const ViewProblems& problems, const Progress& progress);

/// Solves the problem of one view, to a gap of `parameters.gap`.
[[nodiscard]] RayLabeling solve_view(const ViewProblems& problems, ViewIndex view,
                                     const Progress& progress);

void replace_layers_by_ids(const std::vector<std::int32_t>& ids, RayLabeling& labeling);

/// Work of the GPU for all views besides solving the problem of each.
struct DeviceLabeling {
  const RayColors* colors = nullptr;  ///< Null = each ray has its own costs only.
  int votes = 0;                      ///< Rounds of vote_along_rays.
};

/// Whether `parameters` ask for the GPU, and there is something to solve.
[[nodiscard]] bool is_for_device(const RayLabelingInput& input,
                                 const RayLabelingParameters& parameters);

/// Computes labels of all views on the GPU (engine/cuda/ray_labels.h): the result
/// of solve_views and votes on the CPU, but for rounding. Labels are ids. Throws DeviceFailure,
/// Cancelled.
[[nodiscard]] RayLabeling label_on_device(const RayLabelingInput& input,
                                          const RayLabelingParameters& parameters,
                                          const DeviceLabeling& labeling, const Progress& progress);

/// A forest on the GPU (engine/cuda/ray_labels.h), whose votes have the same bits as the
/// kernel's. Throws DeviceFailure, Cancelled.
[[nodiscard]] std::shared_ptr<const cuda::DeviceForest> copy_to_device(const FlatForest& forest,
                                                                       const Progress& progress);

}  // namespace episcope
