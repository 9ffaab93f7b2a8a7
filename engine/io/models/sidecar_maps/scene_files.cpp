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
  const NamePart part = find_part(name, scenes);
  return part.end - part.begin;
}

std::vector<std::string> in_lower_case(std::vector<std::string> names) {
  for (std::string& name : names) name = lower_case(name);
  return names;
}

/// Whether pictures or arrays lie in a folder or in one inside it.
bool may_hold_views(const fs::path& folder) {
  std::error_code error;
  fs::recursive_directory_iterator it(folder, fs::directory_options::skip_permission_denied, error);
  for (const fs::recursive_directory_iterator end; !error && it != end; it.increment(error)) {
    std::error_code ignored;
    if (it.depth() == 1) it.disable_recursion_pending();
    if ((is_image_name(it->path()) || is_array_name(it->path())) && it->is_regular_file(ignored)) {
      return true;
    }
  }
  return false;
}

}  // namespace

SceneFiles::SceneFiles(std::vector<std::string> scenes, std::vector<std::string> others,
                       bool is_only, std::string self)
    : scenes_(in_lower_case(std::move(scenes))),
      others_(in_lower_case(std::move(others))),
      is_only_(is_only),
      self_(std::move(self)) {
  // Another form of the same light field.
  std::erase_if(others_, [&](const std::string& other) {
    return std::ranges::find(scenes_, other) != scenes_.end();
  });
}

bool SceneFiles::is_named_after(const fs::path& file) const {
  const std::string name = file.stem().string();
  return likeness(name, scenes_) > likeness(name, others_);
}

bool SceneFiles::contains(const fs::path& file) const {
  if (file.filename() == self_) return false;
  const std::string name = file.stem().string();
  const std::size_t own = likeness(name, scenes_), of_another = likeness(name, others_);
  return own > of_another || (is_only_ && own == 0 && of_another == 0);
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
    if (!is_map && (is_folder ? may_hold_views(other) : is_array_name(other))) {
      names.push_back(stem);
    }
  }
  return names;
}

}  // namespace episcope::io
