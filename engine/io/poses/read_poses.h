// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/io/poses/camera_pose.h"

#include <filesystem>
#include <string>
#include <vector>

namespace episcope::io {

/// Poses of images, and where from.
struct FoundPoses {
  std::filesystem::path file;                 ///< Empty = there is none.
  std::vector<CameraPose> poses;              ///< Of `images`, in their order.
  std::vector<std::filesystem::path> images;  ///< Those that the file knows.
  std::string problem;                        ///< Why it cannot be used; empty if it can.
};

/// Looks for a file of poses in a folder of images, the folder of the scene around it, and
/// `sparse/0`, `sparse` and `colmap` in both, and reads the first. `images` are sorted by name.
[[nodiscard]] FoundPoses find_poses(const std::filesystem::path& folder,
                                    const std::filesystem::path& scene,
                                    const std::vector<std::filesystem::path>& images);

}  // namespace episcope::io
