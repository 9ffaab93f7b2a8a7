// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/grid/posed_views.h"

#include "engine/core/error.h"
#include "engine/core/text/join.h"
#include "engine/io/grid/image_list.h"
#include "engine/io/open/grid_option.h"
#include "engine/io/poses/pose_grid.h"
#include "engine/io/poses/read_poses.h"

#include <fmt/format.h>

#include <utility>

namespace episcope::io {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> images_of(const fs::path& folder) {
  std::vector<fs::path> images = list_images(folder);
  if (!images.empty()) return images;
  for (const fs::path& part : folders_of_parts(folder)) {
    const std::vector<fs::path> more = list_images(part);
    images.insert(images.end(), more.begin(), more.end());
  }
  return images;
}

PosedViews place_by(FoundPoses found) {
  PosedViews posed{.files = std::move(found.files), .problem = std::move(found.problem)};
  if (!posed.problem.empty()) return posed;
  PoseGrid grid = find_pose_grid(found.poses);
  posed.problem = grid.problem;
  if (!posed.problem.empty()) return posed;
  posed.placed.views.grid = grid.grid;
  for (const std::size_t i : grid.order) posed.placed.views.files.push_back(found.images[i]);
  posed.placed.positions = std::move(grid.positions);
  posed.step = grid.step;
  posed.focal_widths = grid.focal_widths;
  posed.evidence = fmt::format("{} by {}: {}", grid_text(grid.grid), posed.name(), grid.evidence);
  return posed;
}

}  // namespace

std::string PosedViews::name() const {
  std::vector<fs::path> poses = files;
  std::erase_if(poses, [](const fs::path& file) { return file.stem() == "cameras"; });
  return joined(poses, ", ", [](const fs::path& file) { return file.filename().string(); });
}

bool has_parts_with_poses(const fs::path& folder) {
  return count_images(folder) == 0 && !images_of(folder).empty();
}

PosedViews place_by_poses(const fs::path& folder, const OpenOptions& options) {
  if (!options.pattern.empty() || !options.grid.empty() || options.snake) return {};
  PosedViews first;
  for (FoundPoses& found : find_poses(folder, folder.parent_path(), images_of(folder))) {
    PosedViews posed = place_by(std::move(found));
    if (posed.are_used()) return posed;
    if (first.files.empty()) first = std::move(posed);
  }
  return first;
}

void refuse_poses(const fs::path& folder, const PosedViews& poses) {
  throw IoError(folder, fmt::format("by {}, {}; a light field has parallel cameras on a plane, in "
                                    "equal steps: render such views, or name rows and columns by "
                                    "--grid if these are some",
                                    poses.name(), poses.problem));
}

}  // namespace episcope::io
