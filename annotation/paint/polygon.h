// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "annotation/paint/brush.h"

#include <span>

namespace episcope {

/// Pixels of a `height` × `width` view whose centres a closed polygon goes around (non-zero winding
/// number, so that a loop which crosses itself encloses all its parts), as spans from top to
/// bottom, left to right within a row. Fewer than three corners enclose nothing. Complexity
/// O(rows · corners). Throws InvalidInput for a corner that is not finite.
[[nodiscard]] PixelRegion pixels_in_polygon(std::span<const StrokePoint> corners, int height,
                                            int width);

}  // namespace episcope
