// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/disparity_field.h"
#include "engine/core/image.h"
#include "engine/core/progress.h"
#include "engine/labeling/ray_labeling.h"
#include "engine/labeling/ray_targets.h"

#include <cstdint>

namespace episcope {

/// Labels of all views that minimize the energy of [WSG13] as a whole: the costs of all rays,
/// −log p; boundaries within the views, weighted by edges (λ J_st); and μ times the weight of every
/// line of a horizontal or vertical EPI on which the label changes from one view to the next
/// (μ (J_xs + J_yt)), where the point is visible in both (`RayLines`). Relaxed to the simplex and
/// solved with a bound for the whole (engine/solvers/linked_labeling.h), to
/// `parameters.gap_joint`. Energy and bound belong to the joint problem. Throws Cancelled.
///
/// 16 bytes a ray and label and 46 a ray: 5.5 GB for 9×9×512×512 with 13 labels.
[[nodiscard]] RayLabeling smooth_lines(const RayLabelingInput& input,
                                       const RayLabelingParameters& parameters,
                                       const Progress& progress);

/// Labels of one view, solved together with all views that have probabilities, to `parameters.gap`.
[[nodiscard]] RayLabeling smooth_lines_of_view(const RayLabelingInput& input, ViewIndex view,
                                               const RayLabelingParameters& parameters,
                                               const Progress& progress);

/// The energy that `smooth_lines` minimizes, of given labels (ids) of all views that have
/// probabilities.
[[nodiscard]] double line_energy(const RayLabelingInput& input,
                                 const RayLabelingParameters& parameters,
                                 const ViewStack<std::int32_t>& labels);

/// Lines of the horizontal or vertical EPIs from one view to the next of its row or column.
struct RayLines {
  /// `[y][x]`: pixel y'·width + x' of the other view, −1 = the line ends here. No pixel of the
  /// other view is named twice.
  Image<std::int32_t> target;
  Image<std::uint8_t> weight;  ///< Trust in the colors at both ends, `[y][x]`, 255 for 1.
};

/// Input of `find_ray_lines`; borrowed.
struct RayLineSources {
  const DisparityField& disparity;
  const RayColors& colors;
  ViewIndex middle;  ///< The view in which lines run through pixel centers.
};

/// Lines from `view` to `next`, its right or lower neighbor. A line that runs through a pixel
/// center of the middle column (row) of views is drawn through the nearest pixel of every other
/// view, as a line on a screen is: rounded from view to view alone, lines of small slope would
/// never leave their column. A line ends where it leaves the image, where the point is hidden (the
/// disparities differ by more than kSamePointTolerance_px), where the colors are not trusted, and
/// where another line has reached the same pixel. Throws Cancelled.
[[nodiscard]] RayLines find_ray_lines(const RayLineSources& sources, ViewIndex view, ViewIndex next,
                                      const Progress& progress);

}  // namespace episcope
