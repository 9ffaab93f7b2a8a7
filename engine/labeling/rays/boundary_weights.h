// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/array/image.h"

namespace episcope {

/// One probability for each pixel, `[y][x]`: of one per direction (two channels) the larger one.
[[nodiscard]] Image<float> larger_edge_probability(ImageView<const float> edge_probability);

/// Weights g of boundaries between labels, `[y][x]` in [kMinBoundaryWeight, 1]: 1 − the
/// larger probability of an edge.
inline constexpr float kMinBoundaryWeight = 0.02F;
[[nodiscard]] Image<float> boundary_weights(ImageView<const float> edge_probability);

}  // namespace episcope
