// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/grid/posed_views.h"

#include "engine/io/grid/image_list.h"
#include "engine/io/open/grid_option.h"
#include "engine/io/poses/pose_grid.h"
#include "engine/io/poses/read_poses.h"

#include <fmt/format.h>

namespace episcope::io {

PosedViews place_by_poses(const std::filesystem::path& folder, const OpenOptions& options) {
  if (!options.pattern.empty() || !options.grid.empty() || options.snake) return {};
  FoundPoses found = find_poses(folder, folder.parent_path(), list_images(folder));
  PosedViews posed{.file = found.file, .problem = found.problem};
  if (posed.file.empty() || !posed.problem.empty()) return posed;
  PoseGrid grid = find_pose_grid(found.poses);
  posed.problem = grid.problem;
  if (!posed.problem.empty()) return posed;
  posed.placed.views.grid = grid.grid;
  for (const std::size_t i : grid.order) posed.placed.views.files.push_back(found.images[i]);
  posed.placed.positions = std::move(grid.positions);
  posed.step = grid.step;
  posed.focal_widths = grid.focal_widths;
  posed.evidence = fmt::format("{} by {}: {}", grid_text(grid.grid), found.file.filename().string(),
                               grid.evidence);
  return posed;
}

}  // namespace episcope::io
