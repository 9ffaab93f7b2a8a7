// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/image.h"
#include "engine/core/isa.h"
#include "engine/core/progress.h"

#include <array>
#include <cstdint>
#include <vector>

namespace episcope {

/// The lines from one image to another: where each pixel is seen there.
struct ImageLinks {
  int to = -1;  ///< Number of the other image; −1 = there is none.
  /// `[y][x]`: pixel y'·width + x' of the other image, −1 = none. No pixel there is named twice.
  ImageView<const std::int32_t> target;
  ImageView<const std::uint8_t> weight;  ///< `[y][x]`, 255 for 1. Empty = 1 everywhere.
};

/// Lines leave an image in two directions; at most one line of each enters and leaves a pixel.
inline constexpr int kLinkKinds = 2;

/// One of the images. All have the same size and labels.
struct LinkedImage {
  VolumeView<const std::uint8_t> codes;  ///< `[y][label][x]`: places in the table of costs.
  ImageView<const float> g;              ///< `[y][x]` ≥ 0, one channel. Empty = 1.
  std::array<ImageLinks, kLinkKinds> links;
};

/// A division of several images into L regions together (Potts): labels u in no order,
/// E(u) = Σ c(x, u(x)) + λ Σ ½ Σ_l g · TV([u = l]) + μ Σ_links w · [u differs at its ends].
/// Boundaries within images are measured as in SimplexProblem.
struct LinkedProblem {
  std::vector<LinkedImage> images;
  std::array<float, 256> table = {};  ///< Costs c, finite.
  double smoothness = 0;              ///< λ ≥ 0: cost of one pixel of boundary, in units of c.
  double coherence = 0;               ///< μ ≥ 0: cost of a label that changes along a line.
};

struct LinkedOptions {
  int max_iterations = 300;
  double gap = 1e-2;     ///< Stop once the energy is within this share of the bound.
  int check_every = 10;  ///< Iterations between two checks of the gap.
  Isa isa = best_isa();  ///< Others are for tests.
};

struct LinkedResult {
  int iterations = 0;  ///< Of all images together.
  double energy = 0;   ///< E of the labels written.
  double bound = 0;    ///< ≤ E of every labeling: a certificate.
  bool converged = false;

  /// (energy − bound)/|energy|.
  [[nodiscard]] double relative_gap() const;
};

/// Minimizes LinkedProblem relaxed to u ≥ 0, Σ_l u_l = 1, and takes the largest u_l of each pixel;
/// the best labeling of all looks at the gap is written to `labels`, `[y][x]` of each image,
/// 0 … L − 1. Whatever the duals within their limits, p of pairs within images and q of links,
/// |q| ≤ μ w/2, Σ_x min_l [c_l − div p_l − div q_l] over all images bounds the energy of the whole
/// from below. Source: the energy of [WSG13] with the relaxation of [ZGFN08] and the first-order
/// primal-dual method [CP11], over-relaxed.
///
/// Each image is solved alone first (SimplexSolver), beginning from the one before it where links
/// lead there: that spans large regions, which iterations of the whole then only have to agree on.
/// Unknowns are kept in 16 bits, 16 bytes a pixel and label. Images are processed side by side by
/// `progress.threads()` threads; the result does not depend on their number. Ends after the next
/// iteration at `progress.finish_requested()`. Throws InvalidInput on parts that do not fit,
/// Cancelled on a stop request (checked every row).
LinkedResult solve_linked_labeling(const LinkedProblem& problem, const LinkedOptions& options,
                                   const Progress& progress,
                                   const std::vector<ImageView<int>>& labels);

/// E(labels). Throws InvalidInput on wrong shapes.
[[nodiscard]] double linked_energy(const LinkedProblem& problem,
                                   const std::vector<ImageView<const int>>& labels);

}  // namespace episcope
