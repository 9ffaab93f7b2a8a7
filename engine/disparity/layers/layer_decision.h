// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/array/image.h"

namespace episcope {

/// Misfit of one orientation as a fraction of the misfits of one and of two: (1 − r)/(2 − r − c +
/// 0.03), in [0, 1), with coherence r of one and confidence c of two. The constant decides for one
/// where both fit almost perfectly.
[[nodiscard]] inline float single_misfit_share(float coherence, float confidence) {
  constexpr float least_misfit = 0.03F;
  return (1 - coherence) / (2 - coherence - confidence + least_misfit);
}

/// The largest coherence within 2 px of each pixel, in x and y: the best of the windows that hold
/// the pixel. Beside a silhouette one of them fits one orientation, in front of a transparent
/// surface none does. `rows` is scratch; all are `[y][x]` of one size.
void spread_coherence(ImageView<const float> coherence, Image<float>& rows, Image<float>& spread);

}  // namespace episcope
