// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/grid/image_list.h"

#include "engine/core/text/suffix.h"
#include "engine/io/beside/map_name.h"
#include "engine/io/grid/decode_image.h"
#include "engine/io/grid/inner_grid.h"
#include "engine/io/grid/name_words.h"

#include <algorithm>
#include <string_view>
#include <utility>

namespace episcope::io {
namespace {

namespace fs = std::filesystem;

template <class Visit>
void for_each_image(const fs::path& folder, const Visit& visit) {
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder)) {
    const bool is_hidden = entry.path().filename().string().starts_with('.');
    if (!is_hidden && is_image_name(entry.path()) && entry.is_regular_file(error)) {
      visit(entry.path());
    }
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

std::vector<fs::path> list_images(const fs::path& folder) {
  std::vector<fs::path> images;
  for_each_image(folder, [&](const fs::path& path) { images.push_back(path); });
  // Comparing whole paths, part by part, takes seconds where there are 100,000.
  std::ranges::sort(images, {},
                    [](const fs::path& path) { return std::string_view(path.native()); });
  return images;
}

std::vector<fs::path> list_folders(const fs::path& folder) {
  std::vector<fs::path> folders;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    const bool is_hidden = entry.path().filename().string().starts_with('.');
    if (!is_hidden && entry.is_directory(error)) folders.push_back(entry.path());
  }
  return folders;
}

int count_images(const fs::path& folder) {
  std::error_code error;
  if (!fs::is_directory(folder, error)) return 0;
  int count = 0;
  for_each_image(folder, [&](const fs::path&) { ++count; });
  return count;
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

}  // namespace episcope::io
