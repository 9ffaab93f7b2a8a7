// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>

namespace episcope::io {

/// Short name of a scene for lists and titles: the folder's name for a folder and for lf.h5, else
/// the file's name without suffix; a folder of views called "lf" goes by the folder that it lies
/// in.
[[nodiscard]] inline std::string scene_name(const std::filesystem::path& path) {
  std::error_code error;
  std::filesystem::path whole = std::filesystem::absolute(path, error).lexically_normal();
  if (!whole.has_filename()) whole = whole.parent_path();
  const bool is_folder = std::filesystem::is_directory(whole, error);
  const std::string name = is_folder ? whole.filename().string() : whole.stem().string();
  return name == "lf" ? whole.parent_path().filename().string() : name;
}

}  // namespace episcope::io
