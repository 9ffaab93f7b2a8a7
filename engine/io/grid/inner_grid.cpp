// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/grid/inner_grid.h"

#include "engine/core/error.h"
#include "engine/core/text/suffix.h"
#include "engine/io/beside/map_name.h"
#include "engine/io/grid/image_list.h"
#include "engine/io/grid/name_words.h"
#include "engine/io/grid/view_group.h"

#include <algorithm>
#include <array>
#include <string_view>

namespace episcope::io {
namespace {

namespace fs = std::filesystem;

/// Of which one may be a light field of its own.
bool is_array_name(const fs::path& path) {
  constexpr std::array<std::string_view, 5> suffixes{".h5", ".hdf5", ".mat", ".npy", ".npz"};
  return std::ranges::find(suffixes, suffix_of(path)) != suffixes.end() &&
         !map_kind(path.stem().string());
}

/// Of another form of light fields, which has a reader of its own.
bool is_other_form(const fs::path& folder) {
  std::error_code error;
  return fs::exists(folder / "parameters.cfg", error) ||
         fs::exists(folder / "light_field.json", error);
}

bool holds_grid(const fs::path& folder) {
  constexpr std::size_t kFewestViews = 4;
  try {
    const ViewNames names = find_view_names(folder, list_images(folder));
    return names.views.size() >= kFewestViews && !names.views.front().index;
  } catch (const IoError&) {
    return false;
  }
}

}  // namespace

fs::path only_grid_inside(const fs::path& folder) {
  std::error_code error;
  if (!fs::is_directory(folder, error) || count_images(folder) > 0 || is_other_form(folder)) {
    return {};
  }
  fs::path found;
  for (const auto& entry : fs::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    if (name.starts_with('.')) continue;
    if (!entry.is_directory(error)) {
      if (is_array_name(entry.path())) return {};
      continue;
    }
    const bool is_beside = is_map_folder(name) || names_companions(lower_case(name));
    if (is_beside || count_images(entry.path()) == 0) continue;
    if (!found.empty()) return {};
    found = entry.path();
  }
  return !found.empty() && !is_other_form(found) && holds_grid(found) ? found : fs::path();
}

}  // namespace episcope::io
