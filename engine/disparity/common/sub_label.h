// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/parameter/named.h"

namespace episcope {

/// How a disparity is interpolated between labels from the costs of its label and the two
/// neighbouring labels: not at all, at the vertex of a parabola, or where two lines of equal slope
/// meet (for costs like |·|).
enum class Refinement { None, Parabola, Equiangular };
[[nodiscard]] Names<Refinement> names_of(Refinement);

/// The position of the minimum, in labels from the middle one, at most half a label away. 0 where
/// the costs are not convex.
[[nodiscard]] float sub_label_offset(float before, float here, float after, Refinement refinement);

}  // namespace episcope
