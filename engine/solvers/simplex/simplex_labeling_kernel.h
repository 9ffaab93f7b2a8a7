// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/parallel/isa.h"
#include "engine/solvers/simplex/pair_duals.h"

namespace episcope {

/// The kernel's entry points, one set for each instruction set. Rows of u are `[layer][x]`, `pitch`
/// apart; of the costs `width` apart.
struct SimplexKernel {
  /// One row of u: a step along the divergence and down the costs, projected to u ≥ 0, Σ u = 1;
  /// `ahead` = 2·projected − old. Only on layers that the blocks of `here` name.
  void (*move_primal)(const LayeredShape&, const float* cost, const PairDuals& here,
                      const PairDuals& above, float* u, float* ahead);
  /// One row of the duals: a step along the gradient of `ahead`, projected to the limits;
  /// likewise.
  void (*move_dual)(const LayeredShape&, const float* ahead, const float* ahead_below,
                    const PairDuals& here);
  /// Projects the columns of a row to u ≥ 0, Σ u = 1.
  void (*project)(const LayeredShape&, const float* from, float* to);
  /// Σ_x min_l [c_l − div p_l] of one row, with the duals projected to the limits.
  double (*bound)(const LayeredShape&, const float* cost, const PairDuals& here,
                  const PairDuals& above);
  /// Σ_x <c, u> + Σ limit·|difference of u| over the pairs of one row.
  double (*energy)(const LayeredShape&, const float* cost, const PairDuals& here, const float* u,
                   const float* u_below);
  /// The layer of the largest u of each pixel of one row; of equals the lowest.
  void (*cut)(const LayeredShape&, const float* u, int* labels);
};

EPISCOPE_DECLARE_KERNEL(extern const SimplexKernel kSimplexKernel);

}  // namespace episcope
