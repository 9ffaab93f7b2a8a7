// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

namespace episcope::io {

/// The folder inside `folder` whose images are a grid of views by their names, whatever it is
/// called, if `folder` holds no images and no files of arrays itself, and no other folder inside
/// holds images but for maps (`is_map_folder`). Empty if there is none. Throws filesystem_error.
[[nodiscard]] std::filesystem::path only_grid_inside(const std::filesystem::path& folder);

}  // namespace episcope::io
