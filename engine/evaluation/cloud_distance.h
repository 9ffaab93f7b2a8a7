// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/camera_grid.h"
#include "engine/core/disparity_field.h"
#include "engine/core/progress.h"

#include <cstddef>

namespace episcope {

/// How far the points of one cloud are from another one, in units of the scene.
struct CloudDistance {
  Image<float> distance;   ///< `[y][x]`, of the point of each pixel; NaN = there is none.
  std::size_t points = 0;  ///< How many distances there are.
  double mean = 0;
  double median = 0;
  double percentile95 = 0;  ///< 95 % of the points are at most that far away.
};

/// The distance of every point of `estimate` to the nearest point of `reference`, wherever in the
/// view that is seen (cloud-to-cloud distance): both are maps of one view, placed by
/// `BackProjection`. It is directed: what `reference` has and `estimate` lacks does not count.
/// Exact; a search tree by Boost.Geometry (R*-tree, packed) for each band of rows. Does not depend
/// on the number of threads. Throws InvalidInput if the camera is not known, sizes differ or a map
/// has no point; Cancelled.
[[nodiscard]] CloudDistance cloud_distance(const DisparityView& estimate,
                                           const DisparityView& reference, const CameraGrid& camera,
                                           const Progress& progress);

}  // namespace episcope
