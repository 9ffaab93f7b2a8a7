// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/io/models/names/view_names.h"
#include "engine/io/models/open_options.h"

#include <filesystem>
#include <optional>
#include <string>

namespace episcope::io {

/// The views of folders inside of `folder` that hold one picture each, called the same in all
/// ("view_03_04/rgb.png"), as renderers write them, beside maps of that view. Their names have the
/// numbers of rows and columns, or one number after a word for a view or a camera: folders that are
/// merely counted are scenes of their own. Nothing if `folder` holds images itself. A pattern such
/// as "cam_{index}/0001.png" says which folders and which picture in them are meant, beside others.
/// Throws InvalidInput for a pattern that is none.
[[nodiscard]] std::optional<ViewNames> find_view_folders(const std::filesystem::path& folder,
                                                         const std::string& pattern = {});

/// Likewise the views called `picture`, whatever else the folders hold.
[[nodiscard]] std::optional<ViewNames> find_folders_with(const std::filesystem::path& folder,
                                                         const std::string& picture);

/// Folders that hold a row of views each.
struct RowFolders {
  std::vector<std::vector<std::filesystem::path>> rows;  ///< Of images, by number.
  std::vector<std::vector<double>> numbers;              ///< Of these images, in their names.
  bool are_columns = false;                              ///< By the names of the folders.
  std::string pattern;                                   ///< "row_{row}/view_{col}.png".
};

/// The folders inside of `folder` if they are rows of one light field: their names differ in one
/// number and speak of rows or columns (row, r, v, y, col, c, u, x), and in each of them the images
/// are numbered by one number; or their names are the letters from a on. Folders with mere numbers
/// can also be light fields that follow each other in time: they are rows if there are as many
/// images in each as there are folders, if the option `grid` says so, or if so many images are no
/// square grid. Nothing if `folder` holds images itself.
[[nodiscard]] std::optional<RowFolders> find_row_folders(const std::filesystem::path& folder,
                                                         const OpenOptions& options);

/// The views in the order of the folders and of the images in them. Where folders have fewer images
/// than others, the numbers of these say which are missing, as in `place_views`; then every second
/// row is turned round if `is_snake` says so. Throws IoError that names such a folder if they do
/// not.
[[nodiscard]] PlacedViews place_rows(const std::filesystem::path& folder, const RowFolders& found,
                                     bool is_snake);

}  // namespace episcope::io
