// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/image.h"
#include "engine/core/progress.h"

namespace episcope {

/// A label for every pixel: E(l) = Σ ρ(x, l_x) + Σ w_xy min(α |l_x − l_y|, τ), the second sum over
/// pairs of the 4 neighbors. Neighbors on one surface pay for their difference, and a jump costs
/// τ whatever its height, so that thin things in front of a distant background survive.
struct MessageProblem {
  VolumeView<const float> cost;  ///< ρ, `[y][label][x]`, finite; 2 to 512 labels.
  ImageView<const float>
      across;  ///< w of x and its neighbor to the right, `[y][x]`, ≥ 0; empty = 1.
  ImageView<const float> down;  ///< w of x and its neighbor below, `[y][x]`, ≥ 0; empty = 1.
  float slope = 1;              ///< α > 0.
  float most = 1;               ///< τ > 0.
};

struct MessageResult {
  Image<int> labels;
  int iterations = 0;
  double energy = 0;  ///< Of the labels.
  double bound = 0;   ///< No labels have less.
};

/// Lowers E by sequential tree-reweighted message passing (TRW-S), whose chains are rows and
/// columns: `iterations` sweeps to the lower right and back, of which the last one reads off labels
/// given those above and to the left. The bound never falls (but for rounding). On a single row or
/// column one iteration finds the minimum. Tiles along a diagonal run in parallel; the result does
/// not depend on the number of threads. Memory: 8 bytes per pixel and label. Ends after the current
/// iteration at `progress.finish_requested()`. Throws InvalidInput on wrong shapes or parameters,
/// Cancelled. Source: Kolmogorov 2006 [Kol06].
[[nodiscard]] MessageResult solve_by_messages(const MessageProblem& problem, int iterations,
                                              const Progress& progress);

}  // namespace episcope
