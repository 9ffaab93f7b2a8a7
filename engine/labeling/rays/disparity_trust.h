// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/array/image.h"

namespace episcope {

/// How far the disparity of each pixel is trusted as evidence for labels, `[y][x]` in [0, 1]:
/// min(c/(0.43·s), 1)², c the confidence of the estimate around the pixel (Gaussian, σ = 2 px) and
/// s that which a tenth of the pixels exceed, since methods scale confidence differently; 0 if s is
/// 0. Where an estimate had nothing to hold on to, it is what its neighbours suggested, and says of
/// which label they are. `confidence` `[y][x]` in [0, 1].
[[nodiscard]] Image<float> disparity_trust(ImageView<const float> confidence);

}  // namespace episcope
