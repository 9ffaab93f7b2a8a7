// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/io/poses/camera_pose.h"

#include <filesystem>
#include <string>
#include <vector>

namespace episcope::io {

/// Poses of images, and where from.
struct FoundPoses {
  std::vector<std::filesystem::path> files;   ///< That hold the poses.
  std::vector<CameraPose> poses;              ///< Of `images`, in their order.
  std::vector<std::filesystem::path> images;  ///< Those that the files know.
  std::string problem;                        ///< Why they cannot be used; empty if they can.
};

/// Looks for files of poses in a folder of images, the folder of the scene around it, and
/// `sparse/0`, `sparse` and `colmap` in both, and reads the first form that is there. `images` are
/// sorted by name. Where poses are parted for training and testing (`transforms_train.json` and
/// others beside it), those of all parts come first, then those of each. Empty if there are none.
[[nodiscard]] std::vector<FoundPoses> find_poses(const std::filesystem::path& folder,
                                                 const std::filesystem::path& scene,
                                                 const std::vector<std::filesystem::path>& images);

/// The folders inside of `folder` that hold the images of such parts each: `train`, `val`, `test`.
/// None where it has no such files of poses.
[[nodiscard]] std::vector<std::filesystem::path> folders_of_parts(
    const std::filesystem::path& folder);

}  // namespace episcope::io
