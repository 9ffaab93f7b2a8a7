// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/light_field/light_field.h"
#include "engine/core/parallel/progress.h"

#include <array>
#include <vector>

namespace episcope::io {

/// Five views on a line, the middle one and two on either side, as grey levels; of the vertical
/// axis transposed, so that all motion is along x.
struct LineOfViews {
  Image<float> middle;
  std::array<Image<float>, 2> near;  ///< One step before and one after the middle,
  std::array<Image<float>, 2> far;   ///< and `far_step` before and after.
  int far_step = 0;                  ///< 0 = the axis has fewer than three views.
  double near_share = 1;  ///< Distance of the near views as a part of that of the far ones.
};

/// The motion of points of the middle view, in px between it and the far view after it, positive
/// = to the left; NaN where texture is missing or the match is not distinct.
struct LineMatches {
  LineOfViews views;
  Image<float> shift;
};

/// How far points move between neighbouring views along an axis, at most, in px; hardly any move
/// farther. Found in views of at most 128 px, where up to 24 px are looked for; motion of more than
/// `usual_px` counts where views then agree twice as well.
/// 0 if the axis has fewer than three views or the views have no texture. Throws Cancelled.
[[nodiscard]] double largest_motion(const LightField::Samples& samples, bool is_v, double usual_px,
                                    const Progress& progress);

/// Matches windows of 5×5 px against the views before and those after, whichever fit better, so
/// that what is hidden on one side is matched on the other. Shifts are multiples of 0.5 px. Views
/// are reduced to at most `side` px (by whole factors), and their middle of 512×512 px is looked
/// at. Empty if the axis has fewer than three views, the views have no texture, or points move by
/// more than 48 px of the reduced views. Throws Cancelled.
[[nodiscard]] LineMatches match_line(const LightField::Samples& samples, bool is_v, int side,
                                     const Progress& progress);

}  // namespace episcope::io
