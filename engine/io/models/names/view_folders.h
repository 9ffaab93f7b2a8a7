// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/io/models/names/view_names.h"
#include "engine/io/models/open_options.h"

#include <filesystem>
#include <optional>
#include <string>

namespace episcope::io {

/// Finds views in folders inside `folder` that hold one picture each, of one name
/// ("view_03_04/rgb.png"), as renderers write them beside maps of that view. Names of folders have
/// row and column, or one number after a word for a view or a camera: folders that are merely
/// counted are scenes of their own. A pattern such as "cam_{index}/0001.png" states which folders
/// and which picture are meant. Returns nothing if `folder` holds images itself. Throws
/// InvalidInput for a wrong pattern.
[[nodiscard]] std::optional<ViewNames> find_view_folders(const std::filesystem::path& folder,
                                                         const std::string& pattern = {});

/// Finds the views called `picture` in such folders, whatever else these hold.
[[nodiscard]] std::optional<ViewNames> find_folders_with(const std::filesystem::path& folder,
                                                         const std::string& picture);

/// Folders that hold a row of views each.
struct RowFolders {
  std::vector<std::vector<std::filesystem::path>> rows;  ///< Of images, by number.
  std::vector<std::vector<double>> numbers;              ///< Of these images, in their names.
  bool are_columns = false;                              ///< By the names of the folders.
  std::string pattern;                                   ///< "row_{row}/view_{col}.png".
};

/// Finds folders inside `folder` that are rows of one light field. Their names differ in one number
/// and speak of rows or columns (row, r, v, y, col, c, u, x), and images in each are numbered by
/// one number; or the names are the letters from a on. Folders with mere numbers may also be frames
/// in time. They are rows if each has as many images as there are folders, if the option `grid`
/// says so, or if so many images are no square grid. Returns nothing if `folder` holds images
/// itself.
[[nodiscard]] std::optional<RowFolders> find_row_folders(const std::filesystem::path& folder,
                                                         const OpenOptions& options);

/// Places views in the order of the folders and of the images in them. If folders have fewer images
/// than others, their numbers tell which are missing, as in `place_views`. Then every second row is
/// turned if `is_snake`. Throws IoError that names such a folder if numbers do not tell.
[[nodiscard]] PlacedViews place_rows(const std::filesystem::path& folder, const RowFolders& found,
                                     bool is_snake);

}  // namespace episcope::io
