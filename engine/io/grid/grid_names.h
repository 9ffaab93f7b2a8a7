// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/io/grid/load_views.h"

#include <filesystem>
#include <string>

namespace episcope::io {

/// A folder of images understood as a grid of views.
struct NamedGrid {
  ViewFiles views;
  std::string pattern;  ///< "out_{row}_{col}_*", "{row}_{col}.png", "{index}.png", … as matched.
  int left_out = 0;     ///< Images in the folder that do not belong to the grid.
};

/// Number of images directly in a folder.
[[nodiscard]] int count_images(const std::filesystem::path& folder);

/// Finds row and column of every image from its name: Stanford names
/// (`out_<row>_<col>_<Y>_<X>` with empty tokens skipped), two numbers that vary, or one number
/// whose count is a square. `pattern`, if not empty, is a file name with `{row}` and `{col}` or
/// `{index}`,
/// `*` for anything; `snake` turns every second row round.
/// Throws IoError that says which view is missing, which pattern was tried and how many files
/// matched; InvalidInput for a pattern without the fields.
[[nodiscard]] NamedGrid name_grid(const std::filesystem::path& folder, const std::string& pattern,
                                  bool snake);

}  // namespace episcope::io
