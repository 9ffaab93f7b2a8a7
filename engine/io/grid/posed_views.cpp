// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/grid/posed_views.h"

#include "engine/core/error.h"
#include "engine/core/text/join.h"
#include "engine/io/grid/grid_with_gaps.h"
#include "engine/io/grid/image_list.h"
#include "engine/io/open/grid_option.h"
#include "engine/io/poses/pose_grid.h"
#include "engine/io/poses/read_poses.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <optional>
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

/// The largest part of cameras of which some are missing; empty if that is too small.
std::optional<PlacedViews> part_without_gaps(const PoseGrid& grid,
                                             const std::vector<fs::path>& images) {
  GridWithGaps views{.rows = std::vector<long long>(static_cast<std::size_t>(grid.grid.v)),
                     .columns = std::vector<long long>(static_cast<std::size_t>(grid.grid.u)),
                     .numbering = "from 0"};
  std::iota(views.rows.begin(), views.rows.end(), 0);
  std::iota(views.columns.begin(), views.columns.end(), 0);
  for (const std::size_t i : grid.order) {
    views.files.push_back(i == kNoCamera ? fs::path() : images[i]);
  }
  const auto part = part_to_open(views);
  if (!part) return std::nullopt;
  PlacedViews placed;
  placed.views = files_of_part(views, *part);
  for (int i = 0; i < part->grid.count(); ++i) {
    const ViewIndex view = part->in_whole(part->grid.view_at(i));
    placed.positions.push_back(
        grid.positions[static_cast<std::size_t>(view.v * grid.grid.u + view.u)]);
  }
  placed.warnings.push_back(part_text(views, *part));
  return placed;
}

PosedViews place_by(FoundPoses found) {
  PosedViews posed{.files = std::move(found.files), .problem = std::move(found.problem)};
  if (!posed.problem.empty()) return posed;
  PoseGrid grid = find_pose_grid(found.poses);
  posed.problem = grid.problem;
  if (!posed.problem.empty()) return posed;
  if (std::ranges::find(grid.order, kNoCamera) != grid.order.end()) {
    auto part = part_without_gaps(grid, found.images);
    if (!part) {
      posed.problem = fmt::format("{} cameras do not fill a grid of {} or a part of it",
                                  found.images.size(), grid_text(grid.grid));
      return posed;
    }
    posed.placed = std::move(*part);
    grid.step *= posed.placed.views.part->step;
  } else {
    posed.placed.views.grid = grid.grid;
    for (const std::size_t i : grid.order) posed.placed.views.files.push_back(found.images[i]);
    posed.placed.positions = std::move(grid.positions);
  }
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
  PosedViews with_gaps;
  PosedViews first;
  for (FoundPoses& found : find_poses(folder, folder.parent_path(), images_of(folder))) {
    PosedViews posed = place_by(std::move(found));
    if (posed.are_used() && !posed.placed.views.part) return posed;
    PosedViews& kept = posed.are_used() ? with_gaps : first;
    if (kept.files.empty()) kept = std::move(posed);
  }
  return with_gaps.are_used() ? with_gaps : first;
}

void refuse_poses(const fs::path& folder, const PosedViews& poses) {
  throw IoError(folder, fmt::format("by {}, {}; a light field has parallel cameras on a plane, in "
                                    "equal steps: render such views, or name rows and columns by "
                                    "--grid if these are some",
                                    poses.name(), poses.problem));
}

}  // namespace episcope::io
