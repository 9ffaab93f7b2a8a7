// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/image.h"
#include "engine/core/isa.h"
#include "engine/core/memory.h"
#include "engine/core/progress.h"
#include "engine/solvers/tv_l2_kernel.h"

#include <cstdint>
#include <memory>

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

/// Starts `fine` from the solution on `coarse`, whose z is projected: u bilinear, z linear on the
/// faces and to be projected, rx and ry 1 where there is an edge, for `penalize` to give them their
/// value.
void prolong(const TvL2Level& coarse, const TvL2Level& fine);

/// Denoising of one image `[y][x]` by weighted total variation:
/// P(u) = Σ g |∇u|₂ + 1/(2λ) Σ w (u − f)², forward differences, none across the last row and
/// column.
struct TvL2Problem {
  ImageView<const float>
      f;  ///< Observation. Not finite = unknown: taken as 0 with the least weight.
  ImageView<const float> w;  ///< Weight of the observation, about 1; less than 1e-4 is raised to
                             ///< that. Empty = 1.
  ImageView<const float> g;  ///< Weight of the variation, in (0, 1]. Empty = 1.
  double lambda = 0.1;       ///< Larger smooths more; > 0.
};

struct TvL2Options {
  int max_iterations = 30;
  double gap = 1e-4;     ///< Stop once the duality gap is at most this share of the energy.
  int check_every = 10;  ///< Iterations between two checks of the gap.
};

struct TvL2Result {
  int iterations = 0;  ///< At full resolution.
  double energy = 0;   ///< P(u)
  double gap = 0;  ///< P(u) − D(p) ≥ 0 up to rounding. ½/λ Σ w (u − u*)² ≤ gap bounds the error.
  bool converged = false;

  /// Gap as share of the energy; 0 without energy.
  [[nodiscard]] double relative_gap() const { return energy > 0 ? gap / energy : 0; }
};

/// Minimizes TvL2Problem for many images of one size. Single-threaded and not thread-safe: use one
/// object per thread, about 55 bytes per pixel. The result depends on neither the thread nor
/// earlier calls.
///
/// Method: ADMM on the splitting d = ∇u (Goldstein and Osher 2009, "split Bregman") with
/// over-relaxation 1.7; its linear system (w/λ − div R ∇) u = w/λ f + div(p − R d) is solved
/// inexactly by one multigrid V-cycle with a red-black Gauss-Seidel sweep on either side; the
/// penalty R is fitted to the solution every ten iterations, R ∝ g·√(1/|∇u|) within bounds. Levels
/// are solved coarse to fine, each starting from the u and p of the one below it.
///
/// Why: with w from 1e-3 to 1 most pixels are filled in from far away, which a local iteration does
/// slowly; the primal-dual method of Chambolle and Pock 2011 needs many times the iterations
/// (tests/accuracy/tuning.md).
class TvL2Solver {
 public:
  /// Throws InvalidInput unless both are positive. `isa` other than `best_isa()` is for tests.
  TvL2Solver(int height, int width, Isa isa = best_isa());
  ~TvL2Solver();
  TvL2Solver(TvL2Solver&&) noexcept;

  /// Writes the minimizer to `u`, whose content before the call is not used; `u` may be `f`.
  /// Ends after the next iteration at `progress.finish_requested()`. Throws InvalidInput on a wrong
  /// shape or λ ≤ 0, Cancelled on a stop request (checked every few milliseconds).
  TvL2Result solve(const TvL2Problem& problem, const TvL2Options& options, const Progress& progress,
                   ImageView<float> u);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Division of one image `[y][x]` into two regions: the set E that minimizes
/// λ Per(E; g) − Σ_{E} w s, Per the length of its border weighted by g.
struct BinarySegmentationProblem {
  ImageView<const float> score;  ///< s: positive speaks for E, negative against; in about [−1, 1].
                                 ///< Not finite = unknown.
  ImageView<const float> weight;  ///< w in [1e-4, 1]. Empty = 1.
  ImageView<const float> border;  ///< g in (0, 1]. Empty = 1.
  double lambda = 1;              ///< Larger gives smoother borders and drops larger islands; > 0.
};

/// Writes 1 in E and 0 elsewhere to `region`. The convex relaxation to values in [0, 1] is solved
/// by thresholding the minimizer of TvL2Problem with f = s at 0, since its level sets solve the
/// division for every threshold: globally optimal up to the gap and to the isotropic differences,
/// for which that holds but nearly (the coarea formula is exact in the continuum). A region of
/// width b whose score is 1 is dropped where λ > b/2. `scratch` has the shape of the image and
/// holds the minimizer afterwards. Throws as TvL2Solver::solve. Source: Chan, Esedoglu, Nikolova
/// 2006 [CEN06]; level sets: Chambolle 2005 [Cha05].
TvL2Result segment_binary(TvL2Solver& solver, const BinarySegmentationProblem& problem,
                          const TvL2Options& options, const Progress& progress,
                          ImageView<float> scratch, ImageView<std::uint8_t> region);

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
  double energy = 0;  ///< Of the result, with its p.
};

/// Minimizes TgvL2Problem by `iterations` primal-dual steps [CP11] from u = f, p = 0, rows in
/// parallel; the result does not depend on the number of threads. Step sizes 1/√12 satisfy
/// τσ‖K‖² ≤ 1, since ‖K‖² ≤ 12. Writes u, which may be `f`. 48 bytes per pixel. Ends after the next
/// iteration at `progress.finish_requested()`. Throws InvalidInput on wrong shapes or parameters,
/// Cancelled. Source: Bredies, Kunisch, Pock 2010 [BKP10].
TgvL2Result solve_tgv_l2(const TgvL2Problem& problem, int iterations, const Progress& progress,
                         ImageView<float> u);

}  // namespace episcope
