// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/image.h"
#include "engine/core/isa.h"
#include "engine/core/progress.h"

namespace episcope {

/// A labeling u(x) ∈ {0, …, L − 1} of the pixels of an image, ordered labels:
/// E(u) = Σ ρ(x, u(x)) + Λ Σ g · TV(u), the discrete form of ∫ ρ(x, u) + Λ g |Du|. ρ may be any
/// function of the label, so E has many local minima.
///
/// TV is the crystalline total variation whose unit ball is an octagon: of the four pixels of each
/// cell (x, y)…(x + 1, y + 1), (√2 − 1)·(|u_right − u| + |u_down − u|) +
/// (1 − 1/√2)·(|u_across − u| + |u_right − u_down|), times g(x, y); at the image's border, where
/// diagonals are missing, the sides count their share too. A straight boundary costs its Euclidean
/// length if it runs along the axes or diagonals, and at most 8 % more in between.
/// Why not √(|u_right − u|² + |u_down − u|²): its relaxation is not tight, so rounded optima stay
/// above the lower bound, and a diagonal boundary costs 1 or √2 times its length, depending on
/// whether it falls or rises. With differences of pairs every threshold of an optimum is an optimal
/// labeling, and the gap closes.
struct LiftedProblem {
  VolumeView<const float> cost;  ///< ρ, `[y][label][x]`, finite, any scale.
  ImageView<const float> g;      ///< `[y][x]` ≥ 0, one channel. Empty = 1.
  double smoothness = 0;  ///< Λ ≥ 0: cost of one label of jump along one pixel of boundary.
};

struct LiftedOptions {
  int max_iterations = 1000;
  double gap = 1e-3;     ///< Stop once E(u) − D ≤ gap·|E(u)|.
  int check_every = 10;  ///< Iterations between two checks of the gap.
};

struct LiftedResult {
  Image<int> labels;  ///< The best labeling found.
  int iterations = 0;
  double energy = 0;  ///< E(labels)
  double bound = 0;   ///< D ≤ every E(u): a certificate.
  bool converged = false;

  /// (E − D)/|E|, ≥ 0 up to rounding.
  [[nodiscard]] double relative_gap() const;
};

/// Finds a global optimum of LiftedProblem up to the gap, by functional lifting: with
/// φ_l(x) = [u(x) ≥ l] relaxed to 1 ≥ φ_1 ≥ … ≥ φ_{L−1} ≥ 0 the energy becomes convex. Duals p of
/// the pairs, |p| ≤ Λ g w on every layer; whatever they are,
/// D = Σ_x min_k [ρ_k − Σ_{l ≤ k} div p_l] bounds the energy from below.
/// Source: Pock, Cremers, Bischof, Chambolle 2010 [PCBC10]; Chambolle and Pock 2011.
///
/// Departures from it: the costs are minimized exactly along the labels of each pixel, by
/// projecting φ − τ∇ρ onto non-increasing sequences (isotonic regression), instead of by a dual of
/// their own in the third dimension, and steps are over-relaxed by 1.9. Both save most of the
/// iterations (tests/accuracy/tuning.md). φ starts as the step at the cheapest label, p as 0. Step
/// sizes follow from Λ alone, so the scale of the costs does not matter.
///
/// Takes 5 floats per pixel and label besides the costs. The result depends neither on the number
/// of threads nor on constants added to all costs of a pixel (up to rounding).
/// Stops at `progress.finish_requested()` with the best labeling so far. Throws InvalidInput on
/// wrong shapes, a negative Λ or more than 512 labels, Cancelled on a stop request.
[[nodiscard]] LiftedResult solve_lifted_labeling(const LiftedProblem& problem,
                                                 const LiftedOptions& options,
                                                 const Progress& progress, Isa isa = best_isa());

}  // namespace episcope
