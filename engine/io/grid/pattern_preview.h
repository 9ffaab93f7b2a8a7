// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/array/indices.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace episcope::io {

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
