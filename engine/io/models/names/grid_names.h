// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/progress.h"
#include "engine/io/models/names/view_names.h"
#include "engine/io/models/open_options.h"

#include <filesystem>
#include <string>
#include <vector>

namespace episcope::io {

/// Views placed by the poses of their cameras.
struct PosedViews {
  std::vector<std::filesystem::path> files{};  ///< Of the poses; empty = there are none.
  PlacedViews placed{};
  double step = 0;          ///< Of neighboring cameras, in units of the scene.
  double focal_widths = 0;  ///< Focal length in widths of a view; 0 = not stated.
  std::string evidence{};   ///< For the report: "9×9 by transforms.json: cameras in steps of …".
  std::string problem{};    ///< Why the poses are not used, as a clause; empty if they are.

  [[nodiscard]] bool are_used() const { return !files.empty() && problem.empty(); }
  /// Name of the files of poses: "transforms.json".
  [[nodiscard]] std::string name() const;
};

/// Whether all images of a folder lie in subfolders that its files of poses name.
[[nodiscard]] bool has_parts_with_poses(const std::filesystem::path& folder);

/// Folder of images understood as a grid of views.
struct NamedGrid {
  PlacedViews placed;
  std::string pattern;                          ///< As in ViewNames.
  std::vector<std::filesystem::path> left_out;  ///< Images of the folder that are no views.
  PosedViews poses{};                           ///< What poses say, without the views themselves.
};

/// Several grids that a list of `count` views could be, the squarest first, and the two lines.
[[nodiscard]] std::vector<ReadingChoice> possible_grids(int count);

/// Places every view: by the poses of their cameras if a file states them and they form a light
/// field; else by name. The option `pattern` decides on names, else their common form
/// (view_names.h), or their folders (view_folders.h). The option `snake` turns every second row. A
/// list of views is not yet a grid. Throws IoError that says which view is missing, which pattern
/// was tried and how many files matched. Throws InvalidInput for a wrong pattern.
[[nodiscard]] NamedGrid name_grid(const std::filesystem::path& folder, const OpenOptions& options);

/// Gives the views their final rows and columns: the option `grid` decides for a list, else the
/// images (list_layout.h). Returns a sentence about the finding, empty if the names suffice. Throws
/// Undecided if the images of a list tell nothing, IoError if the number of views contradicts the
/// option or the poses form no light field, InvalidInput for a wrong option, Cancelled.
std::string settle_grid(const std::filesystem::path& folder, NamedGrid& named,
                        const OpenOptions& options, const Progress& progress);

}  // namespace episcope::io
