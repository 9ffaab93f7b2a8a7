// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

namespace episcope::capture {

/// Checks that a PLY file holds all the elements that its header announces: assimp 5.2 hangs on
/// headers without an end and reads beyond the end of truncated elements. Linear in the faces.
/// Throws IoError.
void require_whole_ply(const std::filesystem::path& path);

}  // namespace episcope::capture
