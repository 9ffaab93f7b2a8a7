// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/labeling/rays/kept_solver.h"
#include "engine/labeling/rays/label_costs.h"
#include "engine/labeling/rays/ray_labeling.h"
#include "engine/solvers/simplex/simplex_labeling.h"

#include <optional>

namespace episcope {

/// Iterations between two looks at the gap: one costs half an iteration, and 30 iterations are
/// enough.
inline constexpr int kGapCheckEvery = 5;

/// At first far labels are left out of the race for so many, and for so many where a kept solver
/// goes on.
inline constexpr int kRacingIterations = 25, kRacingWhenGoingOn = 10;

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
  [[nodiscard]] Image<float> weights(ViewIndex view) const;
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

}  // namespace episcope
