// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/light_field/camera_grid.h"
#include "engine/core/light_field/disparity_field.h"

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

namespace episcope {

/// Coloured points: x to the right, y up, z towards the viewer (image axes with y and z turned).
struct PointCloud {
  std::vector<std::array<float, 3>> positions;
  std::vector<std::array<std::uint8_t, 3>> colors;  ///< One a position.
  std::vector<PixelIndex> pixels{};  ///< Where each is from, one a position; may be empty.
  /// Of positions; empty: the points alone are drawn.
  std::vector<std::array<std::uint32_t, 3>> triangles{};
  bool is_metric = false;  ///< Positions are in scene units, not in stretched disparity.
};

/// A cloud with fewer points of it, to be drawn while it moves.
struct CloudPart {
  PointCloud all;
  PointCloud few;  ///< Without positions: `all` is drawn then as well.
};

/// A box {x0, x1, y0, y1, z0, z1} around the bulk of a cloud: half a percent of the points may lie
/// beyond each of its sides, so that a few wild depths do not shrink the rest to a dot. All 0 for
/// an empty cloud. Linear.
[[nodiscard]] std::array<double, 6> robust_bounds(const PointCloud& cloud);

/// How many points of a view make a cloud, and how deep they lie where that is a matter of taste.
struct CloudSampling {
  int step = 1;  ///< Every `step`-th pixel of both directions is taken.
  /// z of one px of disparity where the camera is not known; none = a 20th of the larger image
  /// side.
  std::optional<double> z_per_px{};
};

/// The valid pixels of one view, placed by `BackProjection`, in the order of rows. `rgba` is
/// `[y][x][4]` and has the size of the map. Throws InvalidInput if not, or if the step is < 1.
[[nodiscard]] PointCloud make_point_cloud(const DisparityView& view, const CameraGrid& camera,
                                          ImageView<const std::uint8_t> rgba,
                                          const CloudSampling& sampling = {});

}  // namespace episcope
