// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/io/poses/camera_pose.h"

#include <filesystem>
#include <vector>

namespace episcope::io {

/// Poses of `poses_bounds.npy`, N×17: for each image, in the order of names, a 3×5 matrix whose
/// columns are down, right, backwards, the place of the camera, and height, width and focal length
/// in px; then two bounds of depth, which are not used. Images are not named. Throws IoError.
[[nodiscard]] std::vector<CameraPose> read_llff_poses(const std::filesystem::path& path);

}  // namespace episcope::io
