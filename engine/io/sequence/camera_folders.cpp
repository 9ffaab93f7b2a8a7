// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/sequence/camera_folders.h"

#include "engine/io/grid/image_list.h"
#include "engine/io/grid/view_folders.h"
#include "engine/io/sequence/frame_names.h"

namespace episcope::io {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> names_of(const std::vector<fs::path>& images) {
  std::vector<fs::path> names;
  for (const fs::path& image : images) names.push_back(image.filename());
  return names;
}

}  // namespace

CameraFrames find_camera_folders(const fs::path& folder) {
  constexpr std::size_t kFewestFolders = 4;
  const std::vector<fs::path> folders = list_folders(folder);
  if (folders.size() < kFewestFolders || count_images(folder) > 0) return {};
  const NumberedFrames frames = numbered_images(folders.front());
  const std::vector<fs::path> images = list_images(folders.front());
  if (frames.paths.empty() || frames.paths.size() != images.size()) return {};
  const std::vector<fs::path> names = names_of(images);
  for (const fs::path& other : folders) {
    if (names_of(list_images(other)) != names) return {};
  }
  CameraFrames found;
  for (std::size_t i = 0; i < frames.paths.size(); ++i) {
    const auto views = find_folders_with(folder, frames.paths[i].filename().string());
    if (!views) return {};
    found.numbers.push_back(frames.numbers[i]);
    found.patterns.push_back(views->pattern);
  }
  return found;
}

}  // namespace episcope::io
