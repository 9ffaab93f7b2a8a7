// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/indices.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace episcope::io {

/// The folder inside `folder` whose images are a grid of views by their names, whatever it is
/// called, if `folder` holds no images and no files of arrays itself, and no other folder inside
/// holds images but for maps (`is_map_folder`). Empty if there is none. Throws filesystem_error.
[[nodiscard]] std::filesystem::path only_grid_inside(const std::filesystem::path& folder);

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

/// What a pattern makes of one image.
struct NamePreview {
  std::string name;
  bool is_match = false;
  std::optional<long long> row{};  ///< As the name says,
  std::optional<long long> column{};
  std::optional<long long> index{};
  std::optional<ViewIndex> view{};  ///< and where that is in the grid, if there is one.
};

/// What a pattern makes of a folder.
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

/// What `pattern` (name_pattern.h), or if it is empty the one that is detected, makes of the images
/// of a folder of views, or of a scene's folder with such a folder inside. `snake` as the option.
/// Looks at names only, and throws nothing for a pattern that is wrong or does not fit. Throws
/// IoError if the folder cannot be read.
[[nodiscard]] PatternPreview preview_pattern(const std::filesystem::path& folder,
                                             const std::string& pattern, bool snake);

}  // namespace episcope::io
