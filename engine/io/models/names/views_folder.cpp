// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/models/names/views_folder.h"

#include "engine/core/error.h"
#include "engine/core/text.h"
#include "engine/io/base/image_file.h"
#include "engine/io/models/names/name_parts.h"
#include "engine/io/models/names/view_names.h"
#include "engine/io/models/sidecar_maps/map_name.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <string_view>
#include <utility>

namespace episcope::io {
namespace {

namespace fs = std::filesystem;

/// Of which one may be a light field of its own.
bool may_hold_light_field(const fs::path& path) {
  constexpr std::array<std::string_view, 5> suffixes{".h5", ".hdf5", ".mat", ".npy", ".npz"};
  return std::ranges::find(suffixes, suffix_of(path)) != suffixes.end() &&
         !map_kind(path.stem().string());
}

/// Of another form of light fields, which has a reader of its own.
bool has_own_reader(const fs::path& folder) {
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

/// The only folder inside that is named "viewpoints…", as PlenoptiCam names it beside refocused
/// pictures; else the folder itself.
fs::path viewpoints_folder(const fs::path& folder) {
  std::error_code error;
  fs::path found;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    const bool is_named = entry.path().filename().string().starts_with("viewpoints");
    if (!is_named || count_images(entry.path()) < 2) continue;
    if (!found.empty()) return folder;
    found = entry.path();
  }
  return found.empty() ? folder : found;
}

}  // namespace

fs::path only_grid_inside(const fs::path& folder) {
  std::error_code error;
  if (!fs::is_directory(folder, error) || count_images(folder) > 0 || has_own_reader(folder)) {
    return {};
  }
  fs::path found;
  for (const auto& entry : fs::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    if (name.starts_with('.')) continue;
    if (!entry.is_directory(error)) {
      if (may_hold_light_field(entry.path())) return {};
      continue;
    }
    const bool is_beside = is_map_folder(name) || names_companions(lower_case(name));
    if (is_beside || count_images(entry.path()) == 0) continue;
    if (!found.empty()) return {};
    found = entry.path();
  }
  return !found.empty() && !has_own_reader(found) && holds_grid(found) ? found : fs::path();
}

fs::path named_views_folder(const fs::path& folder) {
  std::error_code error;
  const auto images_inside = [&](const char* name) {
    const bool is_folder_itself = fs::equivalent(folder / name, folder, error);
    return is_folder_itself ? 0 : count_images(folder / name);
  };
  for (const char* name : {"lf", "views"}) {
    if (images_inside(name) > 1) return folder / name;
  }
  for (const char* name : {"images", "rectified", "image", "rgb", "color"}) {
    const int inside = images_inside(name);
    if (inside > 1 && inside > count_images(folder)) return folder / name;
  }
  return viewpoints_folder(folder);
}

fs::path views_folder(const fs::path& folder) {
  fs::path named = named_views_folder(folder);
  if (named != folder) return named;
  fs::path only = only_grid_inside(folder);
  return only.empty() ? folder : only;
}

std::vector<std::string> other_picture_folders(const fs::path& source, const fs::path& views) {
  std::vector<std::string> names;
  if (source == views) return names;
  for (const auto& entry : fs::directory_iterator(source)) {
    std::string name = entry.path().filename().string();
    const bool is_map = is_map_folder(name) || names_companions(lower_case(name));
    if (name.starts_with('.') || is_map || entry.path() == views) continue;
    if (count_images(entry.path()) > 1) names.push_back(std::move(name));
  }
  std::ranges::sort(names);
  return names;
}

namespace {

std::string detected_pattern(const fs::path& folder, const std::vector<fs::path>& images) {
  try {
    return find_view_names(folder, images).pattern;
  } catch (const IoError&) {
    return {};
  }
}

/// Where views are, by path.
std::map<fs::path, ViewIndex> places_of(const ViewFiles& views) {
  std::map<fs::path, ViewIndex> places;
  for (int i = 0; i < views.grid.count(); ++i) {
    places.emplace(views.files[static_cast<std::size_t>(i)], views.grid.view_at(i));
  }
  return places;
}

void describe(const ViewNames& names, const std::map<fs::path, ViewIndex>& places,
              const std::vector<fs::path>& images, PatternPreview& preview) {
  std::map<fs::path, const NamedView*> matches;
  for (const NamedView& view : names.views) matches.emplace(view.path, &view);
  const std::size_t count = std::min(images.size(), PatternPreview::kMostNames);
  for (std::size_t i = 0; i < count; ++i) {
    NamePreview name{.name = images[i].filename().string()};
    if (const auto match = matches.find(images[i]); match != matches.end()) {
      name.is_match = true;
      name.row = match->second->row;
      name.column = match->second->column;
      name.index = match->second->index;
    }
    if (const auto place = places.find(images[i]); place != places.end()) name.view = place->second;
    preview.names.push_back(std::move(name));
  }
}

/// Fills in all but `detected`.
void preview_names(const fs::path& folder, const std::vector<fs::path>& images,
                   const std::string& pattern, bool snake, PatternPreview& preview) {
  ViewNames names;
  std::map<fs::path, ViewIndex> places;
  try {
    names = pattern.empty() ? find_view_names(folder, images) : match_view_names(images, pattern);
    preview.matches = static_cast<int>(names.views.size());
    if (names.views.size() < 2) {
      preview.problem = fmt::format("{} of {} images match; a grid has two or more views",
                                    names.views.size(), images.size());
    } else {
      const PlacedViews placed = place_views(folder, snake ? with_turned_rows(names) : names);
      preview.grid = placed.views.grid;
      preview.is_list = placed.is_list;
      preview.warnings = placed.warnings;
      if (placed.gaps) preview.warnings.push_back(placed.gaps->text + ": state the grid.");
      if (!placed.is_list) places = places_of(placed.views);
    }
  } catch (const IoError& error) {
    preview.problem = error.sentence();
  } catch (const InvalidInput& error) {
    preview.problem = error.what();
  }
  describe(names, places, images, preview);
}

}  // namespace

PatternPreview preview_pattern(const fs::path& folder, const std::string& pattern, bool snake) {
  try {
    const fs::path inside = views_folder(folder);
    const std::vector<fs::path> images = list_images(inside);
    PatternPreview preview{.images = static_cast<int>(images.size())};
    preview.detected = detected_pattern(inside, images);
    preview_names(inside, images, pattern, snake, preview);
    return preview;
  } catch (const fs::filesystem_error& error) {
    throw IoError(folder,
                  "it cannot be read (" + error.code().message() + "); check its permissions");
  }
}

}  // namespace episcope::io
