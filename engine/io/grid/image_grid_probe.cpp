// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/grid/image_grid_probe.h"

#include "engine/core/error.h"
#include "engine/io/beside/find_maps.h"
#include "engine/io/grid/exif_orientation.h"
#include "engine/io/grid/grid_names.h"
#include "engine/io/grid/image_header.h"
#include "engine/io/grid/image_list.h"
#include "engine/io/open/grid_option.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>

namespace episcope::io {

SceneProbe probe_views(const ViewFiles& views) {
  const ViewIndex center = views.grid.center();
  const int index = center.v * views.grid.u + center.u;
  const ImageHeader header = read_image_header(views.files[static_cast<std::size_t>(index)]);
  for (const std::filesystem::path& corner : {views.files.front(), views.files.back()}) {
    const ImageHeader other = read_image_header(corner);
    if (other.height == header.height && other.width == header.width) continue;
    throw IoError(corner, fmt::format("this view has {}×{} px, but the centre view has {}×{} px; "
                                      "all views must match",
                                      other.width, other.height, header.width, header.height));
  }
  const bool is_turned = is_quarter_turn(views.orientation);
  return {.grid = views.grid,
          .height = is_turned ? header.width : header.height,
          .width = is_turned ? header.height : header.width,
          .channels = header.channels,
          .sample_type = header.sample_type};
}

namespace {

/// "disparity of all views" of the largest set of a kind; empty if there is none.
std::string maps_text(const MapsBeside& maps, MapKind kind, const char* name) {
  std::size_t most = 0;
  for (const MapSet& set : maps.sets) {
    if (set.kind == kind) most = std::max(most, set.entries.size());
  }
  if (most == 0) return {};
  return std::string(name) + (most > 1 ? " of all views" : " of one view");
}

}  // namespace

SceneProbe probe_image_grid(const std::filesystem::path& folder, const OpenOptions& options) {
  const std::filesystem::path inside = views_folder(folder);
  PlacedViews placed = name_grid(inside, options).placed;
  SceneProbe probe = probe_views(placed.views);
  if (placed.is_list) {
    probe.list = placed.views.grid.count();
    probe.grid = given_grid(options).value_or(GridShape());
  }
  const MapsBeside maps = find_maps(placed.views, inside);
  probe.truth = maps_text(maps, MapKind::Disparity, "disparity");
  if (probe.truth.empty()) probe.truth = maps_text(maps, MapKind::Depth, "depth");
  probe.labels = maps_text(maps, MapKind::Labels, "labels");
  return probe;
}

}  // namespace episcope::io
