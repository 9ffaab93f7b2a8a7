// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/parameter/named.h"

namespace episcope {

/// How a disparity is placed between labels by the costs of its label and the neighbours': not at
/// all, at the summit of a parabola, or where two lines of equal slope meet (for costs like |·|).
enum class Refinement { None, Parabola, Equiangular };
[[nodiscard]] Names<Refinement> names_of(Refinement);

/// Where the cost is least, in labels from the one in the middle, at most half a label away. 0
/// where the costs do not bend upwards.
[[nodiscard]] float sub_label_offset(float before, float here, float after, Refinement refinement);

}  // namespace episcope
