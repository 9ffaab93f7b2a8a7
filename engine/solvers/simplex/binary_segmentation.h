// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/solvers/tv_l2/tv_l2.h"

#include <cstdint>

namespace episcope {

/// Division of one image `[y][x]` into two regions: the set E that minimises
/// λ Per(E; g) − Σ_{E} w s, Per the length of its border weighted by g.
struct BinarySegmentationProblem {
  ImageView<const float> score;  ///< s: positive speaks for E, negative against; in about [−1, 1].
                                 ///< Not finite = unknown.
  ImageView<const float> weight;  ///< w in [1e-4, 1]. Empty = 1.
  ImageView<const float> border;  ///< g in (0, 1]. Empty = 1.
  double lambda = 1;              ///< Larger gives smoother borders and drops larger islands; > 0.
};

/// Writes 1 in E and 0 elsewhere to `region`. The convex relaxation to values in [0, 1] is solved
/// by thresholding the minimiser of TvL2Problem with f = s at 0, since its level sets solve the
/// division for every threshold: globally optimal up to the gap and to the isotropic differences,
/// for which that holds but nearly (the coarea formula is exact in the continuum). A region of
/// width b whose score is 1 is dropped where λ > b/2. `scratch` has the shape of the image and
/// holds the minimiser afterwards. Throws as TvL2Solver::solve. Source: Chan, Esedoglu, Nikolova
/// 2006 [CEN06]; level sets: Chambolle 2005 [Cha05].
TvL2Result segment_binary(TvL2Solver& solver, const BinarySegmentationProblem& problem,
                          const TvL2Options& options, const Progress& progress,
                          ImageView<float> scratch, ImageView<std::uint8_t> region);

}  // namespace episcope
