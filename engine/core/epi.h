// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/light_field.h"

namespace episcope {

/// Epipolar plane images (EPIs), gathered as float in [0, 1], with rows along the view axis.
///
/// On an EPI a scene point is a line whose slope dx/du (dy/dv) is −d in canonical axes: views to
/// the right see it further left. `focus_px` shears the EPI about the row of `view`: a point of
/// disparity `focus_px` stands upright. Sheared samples are interpolated linearly, clamped at the
/// border. Source: Bolles, Baker, Marimont 1987 [BBM87]; refocusing by Ng 2006 [Ng06].

/// Direction of an EPI: along the row or the column of views through the current view.
enum class EpiDirection { Horizontal, Vertical };

/// `[u][x][c]` of image row `y` through the views of camera row `view.v`.
/// Throws InvalidInput if view or row lies outside.
[[nodiscard]] Image<float> horizontal_epi(const LightField& light_field, ViewIndex view, int y,
                                          double focus_px = 0);

/// `[v][y][c]` of image column `x` through the views of camera column `view.u`.
/// Throws InvalidInput if view or column lies outside.
[[nodiscard]] Image<float> vertical_epi(const LightField& light_field, ViewIndex view, int x,
                                        double focus_px = 0);

}  // namespace episcope
