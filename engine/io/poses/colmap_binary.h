// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/io/poses/camera_pose.h"

#include <filesystem>
#include <vector>

namespace episcope::io {

/// Poses of COLMAP's `images.bin`, which holds what `images.txt` does (colmap_poses.h), in little
/// endian. Focal lengths come from `cameras.bin` beside it, if it is there. Takes no more memory
/// than a few times the file. Throws IoError.
[[nodiscard]] std::vector<CameraPose> read_binary_colmap_poses(const std::filesystem::path& path);

}  // namespace episcope::io
