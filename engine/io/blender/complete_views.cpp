// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/blender/complete_views.h"

#include "engine/core/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>

namespace episcope::io {
namespace {

/// The views at most `radius` rows and columns from the centre.
ViewCrop around_center(GridShape stored, int radius) {
  const ViewIndex center = stored.center();
  const ViewIndex first{std::max(0, center.v - radius), std::max(0, center.u - radius)};
  const ViewIndex last{std::min(stored.v - 1, center.v + radius),
                       std::min(stored.u - 1, center.u + radius)};
  return {stored, first, {last.v - first.v + 1, last.u - first.u + 1}};
}

}  // namespace

ViewCrop complete_crop(const RenderManifest& manifest) {
  const GridShape grid = manifest.grid;
  std::vector<std::uint8_t> is_complete(static_cast<std::size_t>(grid.count()), 0);
  for (const ViewIndex view : manifest.complete) {
    is_complete[static_cast<std::size_t>(view.v) * grid.u + view.u] = 1;
  }
  const auto is_whole = [&](const ViewCrop& crop) {
    for (int i = 0; i < crop.kept.count(); ++i) {
      const ViewIndex view = crop.kept.view_at(i, crop.first);
      if (is_complete[static_cast<std::size_t>(view.v) * grid.u + view.u] == 0) return false;
    }
    return true;
  };
  if (!is_whole(around_center(grid, 0))) {
    throw IoError(manifest.folder,
                  "no view is rendered yet: the centre comes first; open the folder again later, "
                  "or start the rendering anew if it was stopped");
  }
  int radius = 0;
  while (radius < std::max(grid.v, grid.u) && is_whole(around_center(grid, radius + 1))) ++radius;
  return around_center(grid, radius);
}

std::string progress_text(const RenderManifest& manifest, const ViewCrop& crop) {
  if (!crop.leaves_out()) return {};
  return fmt::format(
      "{} of {} views are rendered so far; shown are the {}×{} around the centre. Read it "
      "again to see more; if the rendering was stopped, the same command in Blender continues it.",
      manifest.complete.size(), manifest.grid.count(), crop.kept.v, crop.kept.u);
}

}  // namespace episcope::io
