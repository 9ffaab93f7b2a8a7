// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/io/poses/camera_pose.h"

#include <filesystem>
#include <vector>

namespace episcope::io {

/// Poses of COLMAP's `images.txt`, of which every second line is one: id, a quaternion (w, x, y, z)
/// and a translation from the scene to the camera, whose y is down and z ahead, the id of the
/// camera, and the name of the image. Focal lengths come from `cameras.txt` beside it, if it is
/// there. Throws IoError.
[[nodiscard]] std::vector<CameraPose> read_colmap_poses(const std::filesystem::path& path);

}  // namespace episcope::io
