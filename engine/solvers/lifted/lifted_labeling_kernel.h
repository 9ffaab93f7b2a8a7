// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/parallel/isa.h"
#include "engine/solvers/simplex/pair_duals.h"

namespace episcope {

inline constexpr int kMaxLiftedLayers = 512;
/// Thresholds of φ that a labeling is read from.
inline constexpr float kLiftedThresholds[] = {0.25F, 0.5F, 0.75F};
inline constexpr int kLiftedCuts = 3;

/// The kernel's entry points, one set for each instruction set.
struct LiftedKernel {
  /// One row of φ: a step along the divergence and down the costs, projected to 1 ≥ φ_1 ≥ … ≥ 0
  /// `ahead` = 2·projected − old. `cost` is `[layer][x]`, `width` apart.
  void (*move_primal)(const LayeredShape&, const float* cost, const PairDuals& here,
                      const PairDuals& above, float* phi, float* ahead);
  /// One row of the duals: a step along the gradient of `ahead`, projected to the limits.
  void (*move_dual)(const LayeredShape&, const float* ahead, const float* ahead_below,
                    const PairDuals& here);
  /// Σ_x min_k [ρ_k − Σ_{l ≤ k} div p_l] of one row, with the duals projected to the limits.
  double (*bound)(const LayeredShape&, const float* cost, const PairDuals& here,
                  const PairDuals& above);
  /// The labels of one row at each threshold.
  void (*cut)(const LayeredShape&, const float* phi, int* const labels[kLiftedCuts]);
};

EPISCOPE_DECLARE_KERNEL(extern const LiftedKernel kLiftedKernel);

}  // namespace episcope
