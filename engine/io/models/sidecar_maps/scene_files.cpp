// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/models/sidecar_maps/scene_files.h"

#include "engine/core/text.h"
#include "engine/io/base/files.h"
#include "engine/io/models/sidecar_maps/map_name.h"

#include <algorithm>
#include <array>
#include <string_view>
#include <system_error>
#include <utility>

namespace episcope::io {
namespace {

namespace fs = std::filesystem;

bool is_array_name(const fs::path& path) {
  constexpr std::array<std::string_view, 5> suffixes{".h5", ".hdf5", ".mat", ".npy", ".npz"};
  return std::ranges::find(suffixes, suffix_of(path)) != suffixes.end();
}

/// Letters of the longest of these names that another holds as whole words.
std::size_t likeness(const std::string& name, const std::vector<std::string>& scenes) {
  const auto is_end = [&](std::size_t at) {
    return at >= name.size() || !(is_letter(name[at]) || is_digit(name[at]));
  };
  std::size_t most = 0;
  for (const std::string& scene : scenes) {
    if (scene.empty()) continue;
    for (auto at = name.find(scene); at != std::string::npos; at = name.find(scene, at + 1)) {
      const bool is_word = (at == 0 || is_end(at - 1)) && is_end(at + scene.size());
      if (is_word) most = std::max(most, scene.size());
    }
  }
  return most;
}

std::vector<std::string> in_lower_case(std::vector<std::string> names) {
  for (std::string& name : names) name = lower_case(name);
  return names;
}

}  // namespace

SceneFiles::SceneFiles(std::vector<std::string> scenes, std::vector<std::string> others,
                       bool is_only)
    : scenes_(in_lower_case(std::move(scenes))),
      others_(in_lower_case(std::move(others))),
      is_only_(is_only) {}

bool SceneFiles::is_named_after(const fs::path& file) const {
  const std::string name = lower_case(file.stem().string());
  return likeness(name, scenes_) > likeness(name, others_);
}

bool SceneFiles::contains(const fs::path& file) const {
  const std::string name = file.stem().string();
  const std::string small = lower_case(name);
  const std::size_t own = likeness(small, scenes_), of_another = likeness(small, others_);
  return own > of_another ||
         (is_only_ && own == of_another && own == 0 && !names_other_scene(name));
}

std::vector<std::string> light_fields_beside(const fs::path& file) {
  std::vector<std::string> names;
  const fs::path folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
  std::error_code error;
  for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error)) {
    const fs::path& other = it->path();
    const std::string name = other.filename().string();
    if (name.starts_with('.') || name == file.filename().string()) continue;
    std::error_code ignored;
    const bool is_folder = it->is_directory(ignored);
    const std::string stem = is_folder ? name : other.stem().string();
    const bool is_map =
        is_folder ? is_map_folder(stem) : map_kind(stem).has_value() || is_bare_truth_name(stem);
    if (!is_map && (is_folder || is_array_name(other))) names.push_back(stem);
  }
  return names;
}

}  // namespace episcope::io
