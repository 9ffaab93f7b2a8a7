// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/array/indices.h"
#include "engine/core/light_field/disparity_field.h"

#include <cstdint>

namespace episcope {

/// Maximum difference of disparities (px per view step) that count as the same scene point.
/// Estimates are off by about 0.05 to 0.2 px; a smaller step in depth hides less than a pixel over
/// four views.
inline constexpr float kSamePointTolerance_px = 0.25F;

/// Where the rays of row `y` of the view `from` arrive in the view that is `step` = (v, u) away
/// from it: pixel (y, x) of disparity d at (y − d·step.v, x − d·step.u), to the nearest pixel,
/// written as y'·width + x'. −1 where the ray leaves the image, where either disparity is invalid,
/// and where the pixel found has another disparity: there the point is hidden. `targets` has a
/// row's width. Precondition: both views have one size.
void find_ray_targets(const DisparityView& from, const DisparityView& to, ViewIndex step, int y,
                      std::int32_t* targets);

/// Columns of a row from `begin` to before `end`.
struct ColumnRange {
  int begin = 0, end = 0;
};
/// Columns of which find_ray_targets takes as many at once.
inline constexpr int kRayColumns = 16;
/// The same of kRayColumns columns or more; the others of `targets` stay as they are.
void find_ray_targets(const DisparityView& from, const DisparityView& to, ViewIndex step, int y,
                      ColumnRange columns, std::int32_t* targets);

}  // namespace episcope
