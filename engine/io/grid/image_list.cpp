// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/grid/image_list.h"

#include "engine/io/grid/decode_image.h"
#include "engine/io/grid/inner_grid.h"

#include <algorithm>

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

}  // namespace

std::vector<fs::path> list_images(const fs::path& folder) {
  std::vector<fs::path> images;
  for_each_image(folder, [&](const fs::path& path) { images.push_back(path); });
  // Comparing whole paths, part by part, takes seconds where there are 100,000.
  std::ranges::sort(images, {},
                    [](const fs::path& path) { return std::string_view(path.native()); });
  return images;
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
  return folder;
}

fs::path views_folder(const fs::path& folder) {
  fs::path named = named_views_folder(folder);
  if (named != folder) return named;
  fs::path only = only_grid_inside(folder);
  return only.empty() ? folder : only;
}

}  // namespace episcope::io
