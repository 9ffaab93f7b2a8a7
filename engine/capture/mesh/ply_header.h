// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

namespace episcope::capture {

/// Checks that a PLY file holds all the elements that its header announces: assimp 5.2 hangs on
/// headers without an end, reads beyond the end of truncated elements, and writes beyond its memory
/// where vertices or faces are listed twice. Linear in the faces.
/// Throws IoError.
void require_whole_ply(const std::filesystem::path& path);

}  // namespace episcope::capture
