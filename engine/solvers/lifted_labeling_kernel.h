// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace episcope {

/// Floats that a row is padded to, the widest vector.
inline constexpr int kLiftedRowUnit = 16;
inline constexpr int kLiftedMostLayers = 512;
/// Pairs of neighbours of a pixel's cell: right, down, down-right, and its right with its lower
/// neighbour.
inline constexpr int kLiftedPairs = 4;
/// Thresholds of φ that a labeling is read from.
inline constexpr float kLiftedThresholds[] = {0.25F, 0.5F, 0.75F};
inline constexpr int kLiftedCuts = 3;

/// What the rows of a lifted problem have in common. `steps` = layers − 1 is the number of layers
/// of φ that are unknown; rows of φ, of its duals and of `ahead` are `[step][x]`, `pitch` apart,
/// pitch > width, all 0 beyond the width and readable for 16 floats before the first.
struct LiftedShape {
  int steps = 0;
  int width = 0;
  long pitch = 0;
  float primal_step = 0, dual_step = 0;
  float relaxation = 1;
};

/// Duals of the pairs of one row, and the largest size each may have (the same on every layer).
struct LiftedDuals {
  float* pair[kLiftedPairs] = {};
  const float* limit[kLiftedPairs] = {};
};

/// The kernel's entry points, one set for each instruction set.
struct LiftedKernel {
  /// One row of φ: a step along the divergence and down the costs, projected to 1 ≥ φ_1 ≥ … ≥ 0;
  /// `ahead` = 2·projected − old. `cost` is `[layer][x]`, `width` apart.
  void (*move_primal)(const LiftedShape&, const float* cost, const LiftedDuals& here,
                      const LiftedDuals& above, float* phi, float* ahead);
  /// One row of the duals: a step along the gradient of `ahead`, projected to the limits.
  void (*move_dual)(const LiftedShape&, const float* ahead, const float* ahead_below,
                    const LiftedDuals& here);
  /// Σ_x min_k [ρ_k − Σ_{l ≤ k} div p_l] of one row, with the duals projected to the limits.
  double (*bound)(const LiftedShape&, const float* cost, const LiftedDuals& here,
                  const LiftedDuals& above);
  /// The labels of one row at each threshold.
  void (*cut)(const LiftedShape&, const float* phi, int* const labels[kLiftedCuts]);
};

namespace baseline {
extern const LiftedKernel kLiftedKernel;
}
namespace avx2 {
extern const LiftedKernel kLiftedKernel;
}
namespace avx512 {
extern const LiftedKernel kLiftedKernel;
}

}  // namespace episcope
