// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/labeling/label_costs.h"
#include "engine/labeling/ray_labeling.h"
#include "engine/solvers/simplex_labeling.h"

namespace episcope {

/// The labeling of one view as a problem of its own, and room to solve it for many views: costs of
/// its labels, weights of its boundaries, the solver. One object for each thread that solves.
class ViewProblem {
 public:
  /// Borrows the input. All views have the size of the first.
  ViewProblem(const RayLabelingInput& input, const RayLabelingParameters& parameters);

  /// Costs of each ray by its own probabilities.
  void fill_own(ViewIndex view);
  /// Costs of each ray's track. Labels ≥ 0 in `known` (which may be empty) are kept by giving them
  /// alone no cost.
  void fill_tracks(ViewIndex view, ImageView<const std::int32_t> known, const Progress& progress);
  /// Solves with the costs last filled. `labels` become layers of the probabilities, 0 … L − 1.
  SimplexResult solve(ViewIndex view, const Progress& progress, ImageView<std::int32_t> labels);

  /// Weights g of the view's boundaries; empty = 1.
  [[nodiscard]] Image<float> weights(ViewIndex view) const;
  [[nodiscard]] const CostTable& table() const { return table_; }

 private:
  void keep(ImageView<const std::int32_t> known);

  const RayLabelingInput& input_;
  const RayLabelingParameters& parameters_;
  CostTable table_;
  SimplexSolver solver_;
  Volume<float> costs_;
};

}  // namespace episcope
