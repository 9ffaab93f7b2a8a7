// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/array/image.h"

namespace episcope {

/// Frobenius norm of the Hessian of a map by the scale of the 2016 benchmark: Scharr's kernel
/// [3, 10, 3]/16 × [1, 0, −1] without the half, applied twice, so every second derivative counts
/// four times; all four terms enter the norm. The border is reflected (… b a | a b …). NaN samples
/// make their surroundings NaN. Source: Honauer et al. 2016 [HJKG16], evaluation toolkit.
[[nodiscard]] Image<float> hessian_norm(const Image<double>& map);

}  // namespace episcope
