// SPDX-License-Identifier: BSD-3-Clause
#include "engine/solvers/simplex/binary_segmentation.h"

#include "engine/core/error.h"

namespace episcope {

TvL2Result segment_binary(TvL2Solver& solver, const BinarySegmentationProblem& problem,
                          const TvL2Options& options, const Progress& progress,
                          ImageView<float> scratch, ImageView<std::uint8_t> region) {
  const TvL2Result result = solver.solve(
      {problem.score, problem.weight, problem.border, problem.lambda}, options, progress, scratch);
  if (region.height != scratch.height || region.width != scratch.width || region.channels != 1) {
    throw InvalidInput("the region and the score of a segmentation must have the same size");
  }
  for (int y = 0; y < region.height; ++y) {
    const float* const from = scratch.row(y);
    std::uint8_t* const to = region.row(y);
    for (int x = 0; x < region.width; ++x) to[x] = from[x] > 0 ? 1 : 0;
  }
  return result;
}

}  // namespace episcope
