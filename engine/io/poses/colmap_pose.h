// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/io/poses/camera_pose.h"

#include <array>
#include <cstdint>

namespace episcope::io {

inline constexpr std::uintmax_t kLargestColmap = 1'000'000'000;  ///< In bytes: with all points.

/// The pose that COLMAP states as a quaternion (w, x, y, z), which has not to be normalised, and a
/// translation, both from the scene to the camera, whose y is down and z ahead.
[[nodiscard]] inline CameraPose colmap_pose(const std::array<double, 7>& numbers) {
  const auto [w, x, y, z, tx, ty, tz] = numbers;
  const double n = 2 / (w * w + x * x + y * y + z * z);
  CameraPose pose{.image = {},
                  .right = {1 - n * (y * y + z * z), n * (x * y - z * w), n * (x * z + y * w)},
                  .down = {n * (x * y + z * w), 1 - n * (x * x + z * z), n * (y * z - x * w)},
                  .ahead = {n * (x * z - y * w), n * (y * z + x * w), 1 - n * (x * x + y * y)}};
  for (std::size_t i = 0; i < 3; ++i) {
    pose.center[i] = -(pose.right[i] * tx + pose.down[i] * ty + pose.ahead[i] * tz);
  }
  return pose;
}

}  // namespace episcope::io
