// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/beside/archived_map.h"

#include "engine/core/error.h"
#include "engine/core/text/join.h"
#include "engine/core/text/suffix.h"
#include "engine/io/arrays/array_maps.h"
#include "engine/io/arrays/array_samples.h"
#include "engine/io/arrays/matlab_file.h"
#include "engine/io/arrays/numpy_file.h"
#include "engine/io/beside/map_name.h"

#include <fmt/format.h>

#include <algorithm>
#include <initializer_list>
#include <memory>
#include <optional>
#include <vector>

namespace episcope::io {
namespace {

namespace fs = std::filesystem;

using Kinds = std::initializer_list<MapKind>;

std::unique_ptr<const ArrayFile> open_archive(const fs::path& path) {
  if (suffix_of(path) == ".mat") return open_matlab_file(path);
  return std::make_unique<const NumpyFile>(path);
}

/// The axes of an array as maps of all views or of one; empty if it is neither.
std::optional<ArrayLayout> map_layout(const ArrayEntry& entry, GridShape grid) {
  if (!entry.other_kind.empty()) return std::nullopt;
  const std::size_t rank = entry.shape.size();
  if (rank != 2 && rank != 4) return std::nullopt;
  const std::string axes = rank == 2 ? "yx" : "vuyx";
  const ArrayLayout layout{entry.shape, in_index_order(axes, entry.order)};
  const bool is_single = layout.has_one_view();
  const bool has_pixels = layout.height() > 1 && layout.width() > 1;
  if (!has_pixels || !(is_single || layout.grid() == grid)) return std::nullopt;
  return layout;
}

struct FoundMap {
  ArrayEntry entry;
  ArrayLayout layout;
};

/// The first one whose name is of these kinds.
const FoundMap* named_map(const std::vector<FoundMap>& maps, Kinds kinds) {
  const auto named = std::ranges::find_if(maps, [&](const FoundMap& map) {
    const auto kind = map_kind(last_name(map.entry.name));
    return kind && std::ranges::find(kinds, *kind) != kinds.end();
  });
  return named == maps.end() ? nullptr : &*named;
}

/// `others` are the kinds to look for where no name is of `kinds`.
FoundMap find_map(const ArrayFile& file, GridShape grid, Kinds kinds, Kinds others) {
  std::vector<FoundMap> maps;
  for (const ArrayEntry& entry : file.entries()) {
    if (auto layout = map_layout(entry, grid)) maps.push_back({entry, std::move(*layout)});
  }
  if (const FoundMap* named = named_map(maps, kinds)) return *named;
  if (const FoundMap* named = named_map(maps, others)) return *named;
  if (maps.size() == 1) return maps.front();
  const std::string held = joined(file.entries(), ", ", [](const ArrayEntry& entry) {
    return entry.name + " (" + content_text(entry) + ")";
  });
  throw IoError(file.path(),
                fmt::format("the file holds {}: {} of one view or of {}×{} views; store the map "
                            "alone or name it after what it is",
                            held.empty() ? "no array" : held,
                            maps.empty() ? "no map" : "several maps", grid.v, grid.u));
}

template <class T>
ViewStack<T> read_archived(const fs::path& path, GridShape grid, Kinds kinds, Kinds others = {}) {
  const std::unique_ptr<const ArrayFile> file = open_archive(path);
  const FoundMap map = find_map(*file, grid, kinds, others);
  return read_map_stack<T>(*file->open(map.entry), map.layout, Progress());
}

}  // namespace

bool is_archive_of_maps(const fs::path& path) {
  const std::string suffix = suffix_of(path);
  return suffix == ".npz" || suffix == ".mat";
}

ViewStack<float> read_archived_values(const fs::path& path, GridShape grid) {
  return read_archived<float>(path, grid, {MapKind::Disparity, MapKind::Depth}, {MapKind::Labels});
}

bool holds_archived_fractions(const fs::path& path, GridShape grid) {
  const std::unique_ptr<const ArrayFile> file = open_archive(path);
  const FoundMap map = find_map(*file, grid, {MapKind::Labels}, {});
  return is_float(map.entry.type) &&
         has_fractions(read_map_stack<float>(*file->open(map.entry), map.layout, Progress()));
}

ViewStack<std::int32_t> read_archived_labels(const fs::path& path, GridShape grid) {
  return read_archived<std::int32_t>(path, grid, {MapKind::Labels});
}

}  // namespace episcope::io
