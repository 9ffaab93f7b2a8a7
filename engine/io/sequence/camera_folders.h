// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/io/sequence/camera_frames.h"

namespace episcope::io {

/// The frames of a folder that holds a folder for each camera, with a picture for each frame in it:
/// "cam_04/0001.png", "03_04/frame_7.png". Pictures are called the same in all of them, by a
/// running number alone or after a word for time; folders have the numbers of rows and columns, or
/// one after a word for a view or a camera. Looks at names only.
[[nodiscard]] CameraFrames find_camera_folders(const std::filesystem::path& folder);

}  // namespace episcope::io
