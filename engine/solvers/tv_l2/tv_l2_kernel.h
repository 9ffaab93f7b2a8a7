// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/parallel/isa.h"

namespace episcope {

/// Floats before and after each row that a kernel may touch; a row is padded to whole pairs of the
/// widest vector.
inline constexpr int kTvL2Margin = 16;
inline constexpr int kTvL2RowUnit = 32;

/// One level of the grid hierarchy of the TV-L2 solver. Planes are `[y][x]`, `pitch` apart, with
/// one row of padding above and two below; all padding is 0 and stays harmless because the
/// coefficients there are 0. Outside the stage that solves a level, u and b hold the multigrid
/// correction.
struct TvL2Level {
  int height = 0, width = 0;
  long pitch = 0;
  float *f = nullptr, *c = nullptr, *g = nullptr;  ///< Observation, w/λ, weight of the variation.
  float* u = nullptr;
  float *zx = nullptr, *zy = nullptr;  ///< p + R·d: the dual is its projection to |p| ≤ g.
  float *rx = nullptr, *ry = nullptr;  ///< Penalty R of the edges right and down; 0 at the border.
  float* inverse = nullptr;            ///< 1/diagonal of the linear system, 0 in the padding.
  float* b = nullptr;                  ///< Right-hand side.
  float data_scale = 1;                ///< Factor of c when the level serves as multigrid level.
};

struct TvL2Step {
  float relaxation = 1;
  bool first = false;     ///< No multigrid correction is pending.
  float* rows = nullptr;  ///< Scratch, `kTvL2ScratchRows` rows of the level's pitch.
};
inline constexpr int kTvL2ScratchRows = 3;

/// Penalty R = scale·g·clamp(√(knee/|∇u|), 1/spread, spread).
struct TvL2Penalty {
  float scale = 1, knee = 1, spread = 1;
  bool first = false;  ///< z holds p, rx and ry tell where edges are: d becomes ∇u.
};

struct TvL2Sums {
  double energy = 0, dual = 0;
};

/// The kernel's entry points, one set for each instruction set.
struct TvL2Kernel {
  /// One iteration on the level being solved, fused row by row: adds the coarse correction,
  /// smooths, moves the dual, renews the right-hand side, smooths, restricts the residual to
  /// `coarse`.
  void (*iterate)(const TvL2Level&, const TvL2Level& coarse, const TvL2Step&);
  /// Multigrid, down: smooths from 0 and restricts the residual.
  void (*descend)(const TvL2Level&, const TvL2Level& coarse);
  /// Multigrid, up: adds the correction and smooths.
  void (*ascend)(const TvL2Level&, const TvL2Level& coarse);
  /// Smooths from 0 until solved: for the coarsest level.
  void (*solve)(const TvL2Level&);
  /// Renews R from u, keeping p and d where |p| = g.
  void (*penalise)(const TvL2Level&, const TvL2Penalty&);
  /// z ← p, its projection to |p| ≤ g.
  void (*project)(const TvL2Level&);
  /// P(u) and D(p); sums of rows in double, in fixed order.
  TvL2Sums (*measure)(const TvL2Level&, float* rows);
};

EPISCOPE_DECLARE_KERNEL(extern const TvL2Kernel kTvL2Kernel);

}  // namespace episcope
