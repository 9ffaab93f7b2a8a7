// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace episcope {

/// Constants that the CPU and the device form of a solver share: kernels and device code include
/// this, and it includes nothing. How values were found: tests/accuracy/tuning.md.

/// TvL2Solver: least weight of data and edges, iterations on each level below the finest, and
/// between two fits of the penalty.
inline constexpr float kTvL2MinWeight = 1e-4F;
inline constexpr int kTvL2CoarseCycles = 20;
inline constexpr int kTvL2PenaltyEvery = 10;
/// The penalty, in units of the spread of f; found on structure-tensor disparities of several
/// scenes. A weaker one leaves u, not the dual, behind: it stays uneven where the solution is flat.
inline constexpr float kTvL2PenaltyScale = 5.0F;
inline constexpr float kTvL2PenaltyKnee = 0.07F;
inline constexpr float kTvL2PenaltySpread = 16.0F;
/// Coarse edges and over-relaxation that are always stable.
inline constexpr float kTvL2SafePace = 1.0F;

/// solve_tgv_l2: the step of primal and dual, 1/√12.
inline constexpr float kTgvStep = 0.28867513F;

/// Over-relaxation of the layered solvers (SimplexSolver, LiftedSolver).
inline constexpr float kOverRelaxation = 1.9F;
/// Pairs of neighbors of a pixel's cell: right, down, down-right, and its right with its lower
/// neighbor. Sides limit the size of duals by √2 − 1, diagonals by 1 − √½ (PairLimits).
inline constexpr int kPairKinds = 4;
inline constexpr float kPairSide = 1.41421356F - 1, kPairDiagonal = 1 - 0.70710678F;
/// Thresholds of φ that a labeling is read from.
inline constexpr int kLiftedCuts = 3;
struct LiftedThresholds {
  float at[kLiftedCuts];
};
inline constexpr LiftedThresholds kLiftedThresholds = {{0.25F, 0.5F, 0.75F}};
/// SimplexSolver: the least side of a coarse level, and its iterations.
inline constexpr int kSimplexMinSide = 16;
inline constexpr int kSimplexCoarseMoves = 30;

/// Cost of labels that only fill a vector or a warp (solve_by_messages).
inline constexpr float kMessageFiller = 1e6F;

}  // namespace episcope
