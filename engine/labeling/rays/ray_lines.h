// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/array/image.h"
#include "engine/core/light_field/disparity_field.h"
#include "engine/core/parallel/progress.h"
#include "engine/labeling/rays/ray_colors.h"

#include <cstdint>

namespace episcope {

/// Where the rays of one view go on to the next view of its row or column: the lines of the
/// horizontal or vertical EPIs between the two.
struct RayLines {
  /// `[y][x]`: pixel y'·width + x' of the other view, −1 = the line ends here. No pixel of the
  /// other view is named twice.
  Image<std::int32_t> target;
  Image<std::uint8_t> weight;  ///< Trust in the colours at both ends, `[y][x]`, 255 for 1.
};

/// What ray lines are found from; borrowed.
struct RayLineSources {
  const DisparityField& disparity;
  const RayColors& colors;
  ViewIndex middle;  ///< The view in which lines run through pixel centres.
};

/// Lines from `view` to `next`, its right or lower neighbour. A line that runs through a pixel
/// centre of the middle column (row) of views is drawn through the nearest pixel of every other
/// view, as a line on a screen is: rounded from view to view alone, lines of small slope would
/// never leave their column. A line ends where it leaves the image, where the point is hidden (the
/// disparities differ by more than kSamePointTolerance_px), where the colours are not trusted, and
/// where another line has reached the same pixel. Throws Cancelled.
[[nodiscard]] RayLines find_ray_lines(const RayLineSources& sources, ViewIndex view, ViewIndex next,
                                      const Progress& progress);

}  // namespace episcope
