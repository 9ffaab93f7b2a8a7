// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/image.h"
#include "engine/core/progress.h"

namespace episcope {

/// Denoising of one image `[y][x]` by weighted total generalized variation of second order:
/// P(u) = min_p Σ g |∇u − p|₂ + κ Σ g |ℰp|_F + 1/(2λ) Σ w (u − f)², where ℰp = ½ (∇p + ∇pᵀ).
/// Forward differences of u, none across the last row and column; backward differences of p, none
/// across the first. Affine images cost nothing; where total variation makes a staircase of a
/// slope, this keeps the slope.
struct TgvL2Problem {
  ImageView<const float> f;  ///< Observation, finite.
  ImageView<const float> w;  ///< Weight of the observation, ≥ 0; at least one positive. Empty = 1.
  ImageView<const float> g;  ///< Weight of the variation, in (0, 1]. Empty = 1.
  double lambda = 0.1;       ///< Larger smooths more; > 0.
  double bend = 2;           ///< κ > 0: relative cost of curvature to jumps, px.
};

struct TgvL2Result {
  int iterations = 0;
  double start_energy = 0;  ///< P of the observation itself, with p = 0.
  double energy = 0;        ///< Of the result, with its p.
};

/// Minimizes TgvL2Problem by `iterations` primal-dual steps [CP11] from u = f, p = 0, rows in
/// parallel; the result does not depend on the number of threads. Step sizes 1/√12 satisfy
/// τσ‖K‖² ≤ 1, since ‖K‖² ≤ 12. Writes u, which may be `f`. 48 bytes per pixel. Ends after the next
/// iteration at `progress.finish_requested()`. Throws InvalidInput on wrong shapes or parameters,
/// Cancelled. Source: Bredies, Kunisch, Pock 2010 [BKP10].
TgvL2Result solve_tgv_l2(const TgvL2Problem& problem, int iterations, const Progress& progress,
                         ImageView<float> u);

}  // namespace episcope
