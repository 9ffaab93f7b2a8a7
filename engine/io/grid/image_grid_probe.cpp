// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/grid/image_grid_probe.h"

#include "engine/core/error.h"
#include "engine/io/beside/find_maps.h"
#include "engine/io/grid/exif_orientation.h"
#include "engine/io/grid/grid_names.h"
#include "engine/io/grid/image_header.h"
#include "engine/io/grid/image_list.h"
#include "engine/io/grid/odd_views.h"
#include "engine/io/open/grid_option.h"

#include <algorithm>
#include <optional>
#include <string>
#include <utility>

namespace episcope::io {
namespace {

using Size = std::pair<int, int>;

/// Nothing for a file that cannot be decoded.
std::optional<Size> size_of(const std::filesystem::path& file) {
  try {
    const ImageHeader header = read_image_header(file);
    return Size{header.height, header.width};
  } catch (const IoError&) {
    return std::nullopt;
  }
}

/// Whether the centre and two corners are of one size.
bool look_alike(const ViewFiles& views) {
  const ViewIndex center = views.grid.center();
  const auto size = size_of(views.file(center));
  return size && size == size_of(views.files.front()) && size == size_of(views.files.back());
}

/// The views without those whose headers differ from most of the others. Throws IoError if too few
/// are left.
ViewFiles those_alike(const ViewFiles& views) {
  std::vector<std::optional<Size>> sizes;
  for (const auto& file : views.files) sizes.push_back(size_of(file));
  const std::optional<Size> usual = majority(sizes);
  std::vector<OddView> odd;
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    if (!usual || sizes[i] != usual) odd.push_back({static_cast<int>(i), {}});
  }
  auto left = without_views(views, odd);
  if (left) return std::move(left->views);
  throw IoError(views.files.front().parent_path(),
                "the views differ in size, or cannot be decoded; all views must match");
}

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

SceneProbe probe_views(const ViewFiles& given) {
  const ViewFiles views = look_alike(given) ? given : those_alike(given);
  const ImageHeader header = read_image_header(views.file(views.grid.center()));
  const bool is_turned = is_quarter_turn(views.orientation);
  return {.grid = views.grid,
          .height = is_turned ? header.width : header.height,
          .width = is_turned ? header.height : header.width,
          .channels = header.channels,
          .sample_type = header.sample_type};
}

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
