// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/io/grid/decode_image.h"
#include "engine/io/open/open_options.h"

#include <filesystem>

namespace episcope::io {

/// Whether a file or folder can be reached; of a link that leads to itself, false.
[[nodiscard]] inline bool is_there(const std::filesystem::path& path) {
  std::error_code error;
  return std::filesystem::exists(path, error);
}

/// The folder of a scene of images, if `path` is one, one of its images or its parameters.cfg; else
/// empty.
[[nodiscard]] inline std::filesystem::path scene_folder(const std::filesystem::path& path) {
  if (std::filesystem::is_directory(path)) return path;
  if (path.filename() != "parameters.cfg" && !is_image_name(path)) return {};
  return path.has_parent_path() ? path.parent_path() : std::filesystem::path(".");
}

/// Whether names of an image grid are given: then no other form of a folder is meant.
[[nodiscard]] inline bool wants_image_grid(const OpenOptions& options) {
  return !options.pattern.empty() || options.snake;
}

}  // namespace episcope::io
