// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/capture/camera.h"
#include "engine/core/image.h"

#include <optional>

namespace episcope::capture {

enum class MarkKind { Corner, Blob };

/// A mark found near a pick.
struct SnappedPick {
  PlanePoint place;  ///< px, centers of pixels have whole coordinates.
  MarkKind kind = MarkKind::Corner;
};

/// The corner, or the center of the blob or ring, within `reach_px` of `pick`, to a fraction of a
/// pixel: where lines along the edges meet, or lines along the gradients, whichever fits better
/// under a Gaussian window of σ = reach_px / 2 that follows the point.
/// `gray` in units of 1/255. Nothing if no such point stays within reach, for lack of structure in
/// two directions, or with contrast no larger than noise (gradients under 3 units/px RMS).
/// Source: Förstner and Gülch, A fast operator for detection and precise location of distinct
/// points, corners and centers of circular features, 1987.
[[nodiscard]] std::optional<SnappedPick> snap_pick(ImageView<const float> gray,
                                                   const PlanePoint& pick, double reach_px);

}  // namespace episcope::capture
