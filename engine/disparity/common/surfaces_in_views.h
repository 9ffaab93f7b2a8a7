// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/array/image.h"
#include "engine/core/array/view_stack.h"
#include "engine/core/parallel/progress.h"

namespace episcope {

/// Disparity where no surface is known.
inline constexpr float kNothingNear = -1e9F;

/// What the surface that is seen from one view covers in every view of the grid: the disparity of
/// the nearest of its points at each pixel, `[v][u][y][x]`; `kNothingNear` where none falls. The
/// point of pixel (x, y) falls to x − d·(u − u_ref), y − d·(v − v_ref), and covers what pixels its
/// square of 1 px overlaps by more than a quarter along both axes, so that a surface that the
/// other view sees slightly larger has no holes. Pixels of disparity
/// `kNothingNear` show no surface. Throws Cancelled.
[[nodiscard]] ViewStack<float> surfaces_in_views(ImageView<const float> disparity,
                                                 ViewIndex reference, GridShape grid,
                                                 const Progress& progress);

}  // namespace episcope
