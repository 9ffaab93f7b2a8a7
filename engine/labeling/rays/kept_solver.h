// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/labeling/label_probabilities.h"
#include "engine/solvers/simplex/simplex_labeling.h"

#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

namespace episcope {

/// The solver of one view's problem, kept between calls while the user paints: a stroke changes
/// little, so the next call takes a few iterations from where the last one ended. The labels of the
/// last problems are kept as well: a stroke that is undone gives the labels from before it, to the
/// last pixel.
class KeptSolver {
 public:
  /// What the solver takes: of its levels 8 floats a pixel and label, and the costs of all but the
  /// first.
  [[nodiscard]] static double bytes(double pixels, int labels);

  /// For the problem of `view`. Whether the last one was of the same view, size and labels, and the
  /// solver goes on from there; else it begins afresh.
  bool prepare(const LabelProbabilities& probabilities, ViewIndex view);
  /// After `prepare`: the labels of an equal problem if it was one of the last, else those that the
  /// solver finds; as SimplexSolver::solve.
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

}  // namespace episcope
