// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/parallel/progress.h"
#include "engine/io/grid/posed_views.h"
#include "engine/io/grid/view_names.h"
#include "engine/io/open/open_options.h"

#include <filesystem>
#include <string>
#include <vector>

namespace episcope::io {

/// A folder of images understood as a grid of views.
struct NamedGrid {
  PlacedViews placed;
  std::string pattern;                          ///< As in ViewNames.
  std::vector<std::filesystem::path> left_out;  ///< Images of the folder that are no views.
  PosedViews poses{};                           ///< What poses say, without the views themselves.
};

/// Finds the place of every view by the poses of their cameras, if a file states them and they are
/// those of a light field (posed_views.h); else from its name: by the option `pattern` if it is
/// given, else by what the names have in common (view_group.h), or by the folders that they are in
/// (row_folders.h, view_folders.h). With the option `snake` every second row is turned round. A
/// list of views is not yet a grid. Throws IoError that says which view is missing, which pattern
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
