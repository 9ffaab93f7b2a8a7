// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/space/point_cloud.h"

namespace episcope {

/// Joins the points of a cloud to a surface of triangles, cut at jumps. `cloud` is that of `view`,
/// every `step`-th pixel.
///
/// The rule: four neighbouring points (`step` pixels apart along x and y) make two triangles,
/// divided along the diagonal whose ends differ less in disparity, or three of them one where the
/// fourth is missing. A triangle is left out if two of its corners differ in disparity by more than
/// `jump_px` · `step`: there one surface ends in front of another. `jump_px` is thus in px of
/// disparity per pixel of the image. Linear. Throws InvalidInput unless jump_px > 0.
void join_to_surface(PointCloud& cloud, const DisparityView& view, int step, double jump_px);

}  // namespace episcope
