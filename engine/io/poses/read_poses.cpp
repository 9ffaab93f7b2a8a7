// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/poses/read_poses.h"

#include "engine/core/error.h"
#include "engine/io/poses/colmap_binary.h"
#include "engine/io/poses/colmap_poses.h"
#include "engine/io/poses/llff_poses.h"
#include "engine/io/poses/nerf_poses.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <utility>

namespace episcope::io {
namespace {

namespace fs = std::filesystem;

struct PoseForm {
  const char* name;
  std::vector<CameraPose> (*read)(const fs::path&);
  const char* cameras = nullptr;  ///< A file beside it that is read, too.
};

constexpr PoseForm kForms[] = {{"transforms.json", read_nerf_poses},
                               {"poses_bounds.npy", read_llff_poses},
                               {"images.txt", read_colmap_poses, "cameras.txt"},
                               {"images.bin", read_binary_colmap_poses, "cameras.bin"}};

constexpr std::array kParts{"train", "val", "test"};  ///< Of data sets for learning.

bool is_file(const fs::path& path) {
  std::error_code error;
  return fs::is_regular_file(path, error);
}

/// The last folder and the name, which with and without a suffix are the same image.
fs::path place_of(std::string image) {
  std::ranges::replace(image, '\\', '/');
  const fs::path path = image;
  return path.parent_path().filename() / path.stem();
}

/// The poses of images by folder and name, or by name alone where no folder agrees.
void match_names(const std::vector<CameraPose>& all, const std::vector<fs::path>& images,
                 FoundPoses& found) {
  for (const bool by_folder : {true, false}) {
    const auto key_of = [&](const std::string& image) {
      const fs::path place = place_of(image);
      return by_folder ? place : place.filename();
    };
    std::map<fs::path, const CameraPose*> by_name;
    for (const CameraPose& pose : all) by_name.emplace(key_of(pose.image), &pose);
    for (const fs::path& image : images) {
      const auto named = by_name.find(key_of(image.string()));
      if (named == by_name.end()) continue;
      found.poses.push_back(*named->second);
      found.images.push_back(image);
    }
    if (!found.images.empty()) return;
  }
  found.problem = "it knows none of the images";
}

/// The poses of the images, in their order where there are no names.
void match(std::vector<CameraPose> all, const std::vector<fs::path>& images, FoundPoses& found) {
  const bool has_names = !all.empty() && !all.front().image.empty();
  if (has_names) {
    match_names(all, images, found);
  } else if (all.size() == images.size()) {
    found.poses = std::move(all);
    found.images = images;
  } else {
    found.problem = fmt::format("it has {} poses for {} images", all.size(), images.size());
  }
}

FoundPoses read_form(const fs::path& folder, const PoseForm& form,
                     const std::vector<fs::path>& images) {
  const fs::path file = folder / form.name;
  FoundPoses found{.files = {file}, .poses = {}, .images = {}, .problem = {}};
  if (form.cameras && is_file(folder / form.cameras)) found.files.push_back(folder / form.cameras);
  try {
    match(form.read(file), images, found);
  } catch (const IoError& damaged) {
    const std::string text = damaged.what();
    const std::string path = damaged.path().string() + ": ";
    found.problem = text.starts_with(path) ? text.substr(path.size()) : text;
  }
  return found;
}

std::string part_file(const char* part) {
  return fmt::format("transforms_{}.json", part);
}

/// All parts together, then each; an image of several parts counts once.
std::vector<FoundPoses> read_parts(const fs::path& folder, const std::vector<fs::path>& images) {
  std::vector<FoundPoses> parts;
  FoundPoses all;
  std::set<fs::path> known;
  for (const char* part : kParts) {
    const std::string name = part_file(part);
    if (!is_file(folder / name)) continue;
    FoundPoses found = read_form(folder, {name.c_str(), read_nerf_poses}, images);
    if (found.problem.empty()) {
      all.files.push_back(found.files.front());
      for (std::size_t i = 0; i < found.images.size(); ++i) {
        if (!known.insert(found.images[i]).second) continue;
        all.images.push_back(found.images[i]);
        all.poses.push_back(found.poses[i]);
      }
    }
    parts.push_back(std::move(found));
  }
  std::ranges::stable_sort(parts, {}, [](const FoundPoses& part) { return !part.problem.empty(); });
  if (all.files.size() > 1) parts.insert(parts.begin(), std::move(all));
  return parts;
}

}  // namespace

std::vector<FoundPoses> find_poses(const fs::path& folder, const fs::path& scene,
                                   const std::vector<fs::path>& images) {
  for (const fs::path& base : {folder, scene}) {
    for (const char* inside : {"", "sparse/0", "sparse", "colmap"}) {
      for (const PoseForm& form : kForms) {
        if (is_file(base / inside / form.name)) return {read_form(base / inside, form, images)};
      }
    }
    if (auto parts = read_parts(base, images); !parts.empty()) return parts;
  }
  return {};
}

std::vector<fs::path> folders_of_parts(const fs::path& folder) {
  std::vector<fs::path> folders;
  for (const char* part : kParts) {
    std::error_code error;
    if (is_file(folder / part_file(part)) && fs::is_directory(folder / part, error)) {
      folders.push_back(folder / part);
    }
  }
  return folders;
}

}  // namespace episcope::io
