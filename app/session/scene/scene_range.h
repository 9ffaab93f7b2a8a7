// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/light_field/estimate.h"
#include "engine/core/light_field/scene.h"

namespace episcope {

/// Disparities of a scene for display: those of the truth, in both layers if it has two, in the
/// centre view (or the view it covers) unless they cannot be, else those that the files promise;
/// {0, 0} if neither is known.
[[nodiscard]] Interval known_disparity_range(const Scene& scene);

/// Disparities that 98 % of the valid pixels of one view of an estimate lie in: of the middle one.
[[nodiscard]] Interval display_range(const Estimate& estimate);

/// The range that pictures of disparity span: what is known of the scene, else the display range of
/// an estimate, else −1 … 1 px. Each may be {0, 0}.
[[nodiscard]] Interval shown_range(Interval known, Interval of_estimate);

/// Disparities that the valid pixels of one view lie in; {0, 0} if none is valid. Linear in pixels.
[[nodiscard]] Interval extent(const DisparityView& view);

}  // namespace episcope
