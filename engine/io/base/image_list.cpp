// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/base/image_list.h"

#include "engine/io/base/image_file.h"

#include <algorithm>
#include <string_view>

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

}  // namespace episcope::io
