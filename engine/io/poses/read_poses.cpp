// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/poses/read_poses.h"

#include "engine/core/error.h"
#include "engine/io/poses/colmap_poses.h"
#include "engine/io/poses/llff_poses.h"
#include "engine/io/poses/nerf_poses.h"

#include <fmt/format.h>

#include <map>

namespace episcope::io {
namespace {

namespace fs = std::filesystem;

struct PoseForm {
  const char* name;
  std::vector<CameraPose> (*read)(const fs::path&);
};

constexpr PoseForm kForms[] = {{"transforms.json", read_nerf_poses},
                               {"poses_bounds.npy", read_llff_poses},
                               {"images.txt", read_colmap_poses}};

/// Names with and without a suffix are the same image.
std::string stem_of(const std::string& image) {
  return fs::path(image).stem().string();
}

/// The poses of the images, by name, or in their order where there are no names.
void match(std::vector<CameraPose> all, const std::vector<fs::path>& images, FoundPoses& found) {
  const bool has_names = !all.empty() && !all.front().image.empty();
  if (!has_names && all.size() != images.size()) {
    found.problem = fmt::format("it has {} poses for {} images", all.size(), images.size());
    return;
  }
  std::map<std::string, const CameraPose*> by_name;
  for (const CameraPose& pose : all) by_name.emplace(stem_of(pose.image), &pose);
  for (std::size_t i = 0; i < images.size(); ++i) {
    const auto named = by_name.find(images[i].stem().string());
    if (has_names && named == by_name.end()) continue;
    found.poses.push_back(has_names ? *named->second : all[i]);
    found.images.push_back(images[i]);
  }
  if (found.images.empty()) found.problem = "it knows none of the images";
}

}  // namespace

FoundPoses find_poses(const fs::path& folder, const fs::path& scene,
                      const std::vector<fs::path>& images) {
  for (const fs::path& base : {folder, scene}) {
    for (const char* inside : {"", "sparse/0", "sparse", "colmap"}) {
      for (const PoseForm& form : kForms) {
        FoundPoses found{
            .file = base / inside / form.name, .poses = {}, .images = {}, .problem = {}};
        std::error_code error;
        if (!fs::is_regular_file(found.file, error)) continue;
        try {
          match(form.read(found.file), images, found);
        } catch (const IoError& damaged) {
          const std::string text = damaged.what();
          const std::string path = damaged.path().string() + ": ";
          found.problem = text.starts_with(path) ? text.substr(path.size()) : text;
        }
        return found;
      }
    }
  }
  return {};
}

}  // namespace episcope::io
