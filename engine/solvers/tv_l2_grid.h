// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/memory.h"
#include "engine/solvers/tv_l2_kernel.h"

namespace episcope {

/// The planes of one level of TvL2Solver, zero where padding. Level k + 1 has half the size of
/// level k, rounded up.
class TvL2Grid {
 public:
  TvL2Grid(int height, int width);

  TvL2Level level;
  float* row = nullptr;  ///< Scratch, one row.

 private:
  LargeArray<float> memory_;
};

/// Data term and weights of a coarser image such that minimizing there approximates minimizing on
/// `fine`: cells of 2×2, whose variation counts their side of 2 pixels.
void coarsen_problem(const TvL2Level& fine, const TvL2Level& coarse);

/// Starts `fine` from the solution on `coarse`, whose z is projected: u bilinear, z linear on the
/// faces and to be projected, rx and ry 1 where there is an edge, for `penalize` to give them their
/// value.
void prolong(const TvL2Level& coarse, const TvL2Level& fine);

/// u = f, z = p = 0, rx and ry as `prolong`.
void start_from_data(const TvL2Level& level);

}  // namespace episcope
