// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace episcope::io {

/// Images directly in a folder, by name. Hidden files, and links that lead nowhere or to
/// themselves, are left out. Throws filesystem_error if the folder cannot be read.
[[nodiscard]] std::vector<std::filesystem::path> list_images(const std::filesystem::path& folder);

/// Folders directly in a folder, in any order, without hidden ones; none if it cannot be opened.
[[nodiscard]] std::vector<std::filesystem::path> list_folders(const std::filesystem::path& folder);

/// Number of images directly in a folder; 0 if there is no such folder.
[[nodiscard]] int count_images(const std::filesystem::path& folder);

/// The folder of views inside that is named lf, views, images, rectified or viewpoints…; else the
/// folder itself.
[[nodiscard]] std::filesystem::path named_views_folder(const std::filesystem::path& folder);

/// The folder of views that a scene's folder has inside, named as above, or the only one with a
/// grid (`only_grid_inside`); else the folder itself.
[[nodiscard]] std::filesystem::path views_folder(const std::filesystem::path& folder);

/// The names of the folders in `source` beside that of the views that hold several pictures, but
/// for maps; by name.
[[nodiscard]] std::vector<std::string> other_picture_folders(const std::filesystem::path& source,
                                                             const std::filesystem::path& views);

}  // namespace episcope::io
