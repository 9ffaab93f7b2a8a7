// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/isa.h"

namespace episcope {

/// Floats before and after each half row that a kernel may touch; a half row is padded to whole
/// pairs of the widest vector.
inline constexpr long kTvL2Margin = 16;
inline constexpr int kTvL2RowUnit = 32;

/// One level of the grid hierarchy of the TV-L2 solver. Rows of a plane lie `pitch` apart and are
/// split: first the pixels of the even columns, `odd` floats further the odd columns. So the
/// pixels of either color of a checkerboard, and their neighbors, are contiguous. One row of
/// padding above and two below; all padding is 0 and stays harmless because the coefficients there
/// are 0. Outside the stage that solves a level, u and b hold the multigrid correction.
struct TvL2Level {
  int height = 0, width = 0;
  long pitch = 0, odd = 0;
  float *cf = nullptr, *c = nullptr;  ///< w/λ, and the same times the observation.
  float* g = nullptr;                 ///< Weight of the variation.
  float* u = nullptr;
  float *zx = nullptr, *zy = nullptr;  ///< p + R·d: the dual is its projection to |p| ≤ g.
  float *rx = nullptr, *ry = nullptr;  ///< Penalty R of the edges right and down; 0 at the border.
  float* inverse = nullptr;            ///< 1/diagonal of the linear system, 0 in the padding.
  float* b = nullptr;                  ///< Right-hand side.
  float data_scale = 1;                ///< Factor of c when the level serves as multigrid level.

  [[nodiscard]] long at(int y, int x) const { return y * pitch + (x & 1) * odd + (x >> 1); }
};

/// How one iteration follows the one before it, and leaves z for the next.
struct TvL2Step {
  float relaxation = 1;
  bool first = false;    ///< No multigrid correction is pending.
  bool resumes = false;  ///< The iteration before has stored z already relaxed.
  bool pauses = false;   ///< Stores z itself, which everything but an iteration needs.
  float* row = nullptr;  ///< Scratch, one row of the level's pitch.
};

/// Penalty R = scale·g·clamp(√(knee/|∇u|), 1/spread, spread).
struct TvL2Penalty {
  float scale = 1, knee = 1, spread = 1;
  bool first = false;  ///< z holds p, rx and ry tell where edges are: d becomes ∇u.
};

struct TvL2Sums {
  double energy = 0, dual = 0;
};

/// The entry points of the iteration, one set for each instruction set.
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
};

/// Entry points for the work between iterations.
struct TvL2PenaltyKernel {
  /// Renews R from u, keeping p and d where |p| = g.
  void (*penalise)(const TvL2Level&, const TvL2Penalty&);
  /// The penalty of the edges between cells of 2×2 pixels, times `edge_factor`. 1 is Galerkin's
  /// choice for piecewise constant corrections; ½ fits smooth ones.
  void (*coarsen_penalty)(const TvL2Level& fine, const TvL2Level& coarse, float edge_factor);
  /// Fills `inverse` from c, rx, ry.
  void (*invert_diagonal)(const TvL2Level&);
  /// z ← p, its projection to |p| ≤ g.
  void (*project)(const TvL2Level&);
  /// P(u) and D(p); sums of rows in double, in fixed order. `row` is scratch as in TvL2Step.
  TvL2Sums (*measure)(const TvL2Level&, float* row);
};

EPISCOPE_DECLARE_KERNEL(extern const TvL2Kernel kTvL2Kernel);
EPISCOPE_DECLARE_KERNEL(extern const TvL2PenaltyKernel kTvL2PenaltyKernel);

}  // namespace episcope
