// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/disparity/epi/line_residuals.h"

namespace episcope {

/// How well lines of one disparity explain a view, as a coherence: 1 − s·e/v, with e the mean over
/// 5×5 pixels of the residuals of `disparity` (LineResiduals) and v what it would be if pixels had
/// nothing to do with their lines, twice the variance of colour there. Each of `coherence` that is
/// less is raised to it. Beside a silhouette, where every window of a structure tensor holds two
/// orientations, lines fit in half of the views at least; behind a transparent surface none fits.
/// The strictness s makes up for views that are near, where other lines fit nearly as well.
/// All images are `[y][x]` of one size; `residuals` has begun the view. Throws Cancelled.
void raise_by_line_fit(ImageView<const std::uint32_t> view, ImageView<const float> disparity,
                       float strictness, LineResiduals& residuals, Image<float>& coherence);

}  // namespace episcope
