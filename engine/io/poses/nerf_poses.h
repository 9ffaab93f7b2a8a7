// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/io/poses/camera_pose.h"

#include <filesystem>
#include <vector>

namespace episcope::io {

/// Poses of `transforms.json`: `frames` with `file_path` and `transform_matrix`, 4×4, from the
/// camera, whose x is right, y up and z backwards, to the scene. Focal length by `camera_angle_x`,
/// or `fl_x` and `w`. Throws IoError.
[[nodiscard]] std::vector<CameraPose> read_nerf_poses(const std::filesystem::path& path);

}  // namespace episcope::io
