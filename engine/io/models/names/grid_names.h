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
  double step = 0;          ///< Of neighbouring cameras, in units of the scene.
  double focal_widths = 0;  ///< Focal length in widths of a view; 0 = not stated.
  std::string evidence{};   ///< For the report: "9×9 by transforms.json: cameras in steps of …".
  std::string problem{};    ///< Why the poses are not used, as a clause; empty if they are.

  [[nodiscard]] bool are_used() const { return !files.empty() && problem.empty(); }
  /// "transforms.json": what the files of the poses are called.
  [[nodiscard]] std::string name() const;
};

/// Whether a folder has no images but in the folders inside that its files of poses speak of.
[[nodiscard]] bool has_parts_with_poses(const std::filesystem::path& folder);

/// Throws IoError that says why the poses are not those of a light field.
[[noreturn]] void refuse_poses(const std::filesystem::path& folder, const PosedViews& poses);

/// A folder of images understood as a grid of views.
struct NamedGrid {
  PlacedViews placed;
  std::string pattern;                          ///< As in ViewNames.
  std::vector<std::filesystem::path> left_out;  ///< Images of the folder that are no views.
  PosedViews poses{};                           ///< What poses say, without the views themselves.
};

/// Finds the place of every view by the poses of their cameras, if a file states them and they form
/// a light field; else from its name: by the option `pattern` if it is given, else by what the names
/// have in common (view_names.h), or by the folders that they are in (view_folders.h). With the
/// option `snake` every second row is turned round. A list of views is not yet a grid. Throws IoError that says which view is missing, which pattern
/// was tried and how many files matched; InvalidInput for a wrong pattern.
[[nodiscard]] NamedGrid name_grid(const std::filesystem::path& folder, const OpenOptions& options);

/// Gives the views the rows and columns that they have in the end: those of the option `grid` for a
/// list, or else those that the images themselves tell (list_layout.h). Returns a sentence about
/// what was found, empty if the names tell all. Throws Undecided if the images of a list tell
/// nothing, IoError if there are not as many views as the option says, or if poses say that they
/// are none, InvalidInput for a wrong option, Cancelled.
std::string settle_grid(const std::filesystem::path& folder, NamedGrid& named,
                        const OpenOptions& options, const Progress& progress);

}  // namespace episcope::io
