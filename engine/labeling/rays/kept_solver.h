// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/labeling/label_probabilities.h"
#include "engine/solvers/simplex/simplex_labeling.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace episcope {

/// The solver of one view's problem, kept between calls while the user paints: a stroke changes
/// little, so the next call takes a few iterations from where the last one ended.
class KeptSolver {
 public:
  /// What it takes: of its levels 8 floats a pixel and label, and the costs of all but the first.
  [[nodiscard]] static double bytes(double pixels, int labels);

  /// For the problem of `view`. Whether the last one was of the same view, size and labels, and the
  /// solver goes on from there; else it begins afresh.
  bool prepare(const LabelProbabilities& probabilities, ViewIndex view);
  /// After `prepare`.
  [[nodiscard]] SimplexSolver& solver() { return *solver_; }
  /// Frees its memory.
  void drop() { solver_.reset(); }

 private:
  std::optional<SimplexSolver> solver_;
  ViewIndex view_;
  int height_ = 0, width_ = 0;
  std::vector<std::int32_t> ids_;
};

}  // namespace episcope
