// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/image.h"
#include "engine/core/isa.h"
#include "engine/core/progress.h"

#include <cstdint>
#include <memory>

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

class LayeredSweep;

/// A division of one image into L regions (Potts): labels u(x) ∈ {0, …, L − 1} in no order,
/// E(u) = Σ c(x, u(x)) + λ Σ ½ Σ_l g · TV([u = l]). A boundary between two regions belongs to both,
/// so it costs λ g times its length, whichever they are.
///
/// TV is the octagonal one of engine/solvers/layered_sweep.h, for the reasons given
/// there: with two labels its relaxation is tight.
struct SimplexProblem {
  VolumeView<const float> cost;  ///< c, `[y][label][x]`, finite.
  ImageView<const float> g;      ///< `[y][x]` ≥ 0, one channel. Empty = 1.
  double smoothness = 0;         ///< λ ≥ 0: cost of one pixel of boundary, in units of c.
};

struct SimplexOptions {
  int max_iterations = 300;
  double gap = 1e-3;     ///< Stop once the primal energy is within this share of the bound.
  int check_every = 10;  ///< Iterations between two checks of the gap.
  /// `[y][x]`: start from the result of the last call, for a similar image. Each pixel starts from
  /// the pixel y'·width + x' of the last image given here, where −1 from the one at its own place.
  /// Empty = start afresh. Ignored in the first call.
  ImageView<const std::int32_t> from_last;
  /// Start where the last call ended, each pixel at its own place: for the same image when its
  /// costs have changed a little. Ignored in the first call.
  bool goes_on = false;
  /// So many iterations at first leave a label out where it costs at least `behind` more than the
  /// cheapest one at every pixel around (engine/solvers/layered_sweep.h): for many labels
  /// they take a fraction of the time. The gap is not looked at before their end.
  int racing_iterations = 0;
  float behind = 1;
};

struct SimplexResult {
  int iterations = 0;
  double energy = 0;   ///< E of the labels written.
  double relaxed = 0;  ///< The least energy found with u relaxed, ≤ `energy`.
  double bound = 0;    ///< ≤ E of every labeling: a certificate.
  bool converged = false;

  /// (relaxed − bound)/|relaxed|, what the method can close; ≥ 0 up to rounding.
  [[nodiscard]] double relative_gap() const;
};

/// Minimizes SimplexProblem relaxed to min over u ≥ 0, Σ_l u_l = 1 of
/// Σ <c, u> + λ/2 Σ_l g·TV(u_l), and takes the largest u_l of each pixel; the best labeling of all
/// looks at the gap is kept. Whatever the duals p of the pairs are, |p| ≤ λ g w/2,
/// Σ_x min_l [c_l − div p_l] bounds the energy from below.
/// Source: Zach, Gallup, Frahm, Niethammer 2008 [ZGFN08] for the relaxation, with the first-order
/// primal-dual method [CP11] over-relaxed by 1.9.
///
/// Departures from it: solved coarse to fine, u and duals of each level starting from the result of
/// the level of half its size, because a large λ bridges regions of hundreds of pixels. The step
/// sizes follow √λ where λ > 1: there the costs, about 1 as −log p, bound the duals, not λ.
/// Evidence: tests/accuracy/tuning.md.
///
/// For many images of one size: 8 floats per pixel and label stay allocated between calls, 13 once
/// `from_last` is used, which saves iterations between neighboring views of a light field. Rows
/// are processed by `progress.threads()` threads; not thread-safe, one object per caller. The
/// result depends on neither the number of threads nor (without `from_last` and `goes_on`) earlier
/// calls.
class SimplexSolver {
 public:
  /// Throws InvalidInput unless all are positive and there are at most 256 labels. `isa` other than
  /// `best_isa()` is for tests.
  SimplexSolver(int height, int layers, int width, Isa isa = best_isa());
  ~SimplexSolver();
  SimplexSolver(SimplexSolver&&) noexcept;

  /// Writes the labeling `[y][x]`, 0 … L − 1. Ends after the next five iterations at
  /// most at `progress.finish_requested()`. Throws InvalidInput on a wrong shape or a negative λ,
  /// Cancelled on a stop request (checked at least once per iteration).
  SimplexResult solve(const SimplexProblem& problem, const SimplexOptions& options,
                      const Progress& progress, ImageView<int> labels);

  /// Unknowns at the end of the last call with λ > 0 and more than one label, for a method that
  /// starts there; φ is u. Valid until the next call.
  [[nodiscard]] LayeredSweep& unknowns();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace episcope
