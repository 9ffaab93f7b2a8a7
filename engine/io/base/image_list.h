// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <vector>

namespace episcope::io {

/// Lists the images directly in a folder, by name. Omits hidden files and links that lead nowhere
/// or to themselves. Throws filesystem_error if the folder cannot be read.
[[nodiscard]] std::vector<std::filesystem::path> list_images(const std::filesystem::path& folder);

/// Lists the visible folders directly in a folder, in any order; none if it cannot be opened.
[[nodiscard]] std::vector<std::filesystem::path> list_folders(const std::filesystem::path& folder);

/// Number of images directly in a folder; 0 if there is no such folder.
[[nodiscard]] int count_images(const std::filesystem::path& folder);

}  // namespace episcope::io
