// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/indices.h"
#include "engine/io/models/names/view_names.h"
#include "engine/io/models/open_options.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace episcope::io {

/// Finds the one folder inside `folder` whose images form a grid of views by their names, whatever
/// it is called. `folder` must hold no images and no files of arrays, and no other folder inside
/// may hold images, except maps (`is_map_folder`). Empty if there is none. Throws filesystem_error.
[[nodiscard]] std::filesystem::path only_grid_inside(const std::filesystem::path& folder);

/// Finds the folder of views inside that is named lf, views, images, rectified or viewpoints…; else
/// returns the folder itself. So it does if another folder beside that holds views and maps: then
/// each is a scene.
[[nodiscard]] std::filesystem::path named_views_folder(const std::filesystem::path& folder);

/// Finds the folder of views inside the folder of a scene: named as above, or the only one with a
/// grid (`only_grid_inside`). Else returns the folder itself.
[[nodiscard]] std::filesystem::path views_folder(const std::filesystem::path& folder);

/// Names of folders in `source`, other than the folder of views, that hold several pictures but no
/// maps; by name.
[[nodiscard]] std::vector<std::string> other_picture_folders(const std::filesystem::path& source,
                                                             const std::filesystem::path& views);

/// Match of a pattern with one image.
struct NamePreview {
  std::string name;
  bool is_match = false;
  std::optional<long long> row{};  ///< As the name says,
  std::optional<long long> column{};
  std::optional<long long> index{};
  std::optional<ViewIndex> view{};  ///< and where that is in the grid, if there is one.
};

/// Match of a pattern with a folder.
struct PatternPreview {
  static constexpr std::size_t kMostNames = 500;

  std::string detected{};            ///< The pattern found without being told; empty if none is.
  std::vector<NamePreview> names{};  ///< The first images by name, at most `kMostNames`.
  int images = 0;                    ///< In the folder,
  int matches = 0;                   ///< and of them those that match.
  GridShape grid{};                  ///< 1×N for a list, whose rows and columns the images tell.
  bool is_list = false;
  std::string problem{};  ///< Why there is no grid, as a sentence; empty if there is one.
  std::vector<std::string> warnings{};  ///< A sentence each: what is missing and left out, ….
};

/// Applies `pattern` (name_pattern.h), or the detected one if it is empty, to the images of a
/// folder of views, or of a scene's folder with such a folder inside. `snake` as the option.
/// Examines names only, and reports a wrong or unfitting pattern as `problem`. Throws IoError if
/// the folder cannot be read.
[[nodiscard]] PatternPreview preview_pattern(const std::filesystem::path& folder,
                                             const std::string& pattern, bool snake);

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

struct RowFolders {
  std::vector<std::vector<std::filesystem::path>> rows;  ///< Of images, by number.
  std::vector<std::vector<double>> numbers;              ///< Of these images, in their names.
  bool are_columns = false;                              ///< By the names of the folders.
  std::string pattern;                                   ///< "row_{row}/view_{col}.png".
};

/// Finds folders inside `folder` that are rows of one light field. Their names differ in one number
/// and speak of rows or columns (row, r, v, y, col, c, u, x), and images in each are numbered by
/// one number. Folders with mere numbers may also be frames
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
