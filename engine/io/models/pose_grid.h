// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/light_field.h"
#include "engine/io/models/poses.h"

#include <cstddef>
#include <string>
#include <vector>

namespace episcope::io {

/// Marks a place without a camera in `PoseGrid::order`.
inline constexpr auto kNoCamera = static_cast<std::size_t>(-1);

/// Cameras as the grid of a light field, in canonical order.
struct PoseGrid {
  GridShape grid{};
  std::vector<std::size_t> order{};         ///< Of the poses, row by row; `kNoCamera` in gaps.
  std::vector<CameraPosition> positions{};  ///< Row by row: right and down in the cameras' view.
  double step = 0;                          ///< Of neighbors, in units of the scene.
  double focal_widths = 0;                  ///< 0 = not stated.
  std::string evidence{};  ///< "cameras in steps of 0.1, turned by 0.01° at most, …".
  std::string problem{};   ///< Why they are no such grid, as a clause; empty if they are.
};

/// Arranges cameras on the grid of a light field: rows and columns along what they see as down and
/// right. Orientations may differ by 0.5°, places by a tenth of a step, steps of rows and columns
/// by a tenth. O(N log N).
[[nodiscard]] PoseGrid find_pose_grid(const std::vector<CameraPose>& poses);

}  // namespace episcope::io
