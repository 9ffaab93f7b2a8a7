// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace episcope::io {

/// Light fields that follow each other in time, all views of which lie in one folder.
struct CameraFrames {
  std::vector<long> numbers{};          ///< In names, ascending; empty = there are none.
  std::vector<std::string> patterns{};  ///< Of the names of each frame: "cam{index}_frame003.png".
};

/// The frames of a folder of images whose names have a number that a word calls that of a frame
/// (`NameWords::is_other_count`), and others that tell the views of a frame apart: two frames or
/// more, of as many views each. Looks at names only.
[[nodiscard]] CameraFrames find_camera_frames(const std::filesystem::path& folder);

}  // namespace episcope::io
