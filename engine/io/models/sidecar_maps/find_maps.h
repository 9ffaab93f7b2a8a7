// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/io/models/names/view_files.h"
#include "engine/io/models/sidecar_maps/map_name.h"
#include "engine/io/models/sidecar_maps/scene_files.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace episcope::io {

/// Files of one kind, folder and name pattern, and the views that they belong to.
struct MapSet {
  /// File, and the number of its view, row by row.
  struct Entry {
    int view = 0;
    std::filesystem::path file;
  };
  MapKind kind = MapKind::Disparity;
  std::string pattern;  ///< "#_#_depth.npy".
  std::vector<Entry> entries;
  /// Files with such names that belong to no view.
  std::vector<std::filesystem::path> strays;
  std::vector<std::filesystem::path> of_left_out{};  ///< Of views that are not in the part opened.
  bool is_named_labels = false;  ///< Disparity whose files are named like labels.
  MapClaim claim = MapClaim::None;
  std::string region{};  ///< What a mask of `MapKind::Region` marks.

  [[nodiscard]] std::vector<std::filesystem::path> files() const;
  /// File of this view; empty if there is none.
  [[nodiscard]] std::filesystem::path file_of(int view) const;
};

struct ComputedMap {
  std::filesystem::path file;
  MapKind kind = MapKind::Disparity;
};

struct FoundMapSets {
  std::vector<MapSet> sets;
  /// Other folders that were searched and hold maps.
  std::vector<std::filesystem::path> folders;
  /// Files that are named like maps, but computed (`MapClaim::Computed`).
  std::vector<ComputedMap> computed;
};

/// Finds maps by their names (`map_kind`), without opening a file. Searches the folder of the views
/// and folders inside it (`is_map_folder`). Searches around it if it is called lf, views or the
/// like or has a `kBaselineFile`. Searches beside each view if each has a folder of its own.
/// Numbers in names match the numbers of the views, or count the views row by row from any number.
/// A single map without such numbers belongs to the center view of the whole grid. Ignores files
/// that are not `own`, where several light fields share a folder, and those of another frame by the
/// numbers behind words for time, where names of views have such. In folders of maps beside that of
/// the views a file of the same name as the latter holds a map of the scene. Linear in the files.
[[nodiscard]] FoundMapSets find_maps(const ViewFiles& views, const std::filesystem::path& folder,
                                     const std::optional<SceneFiles>& own = {});

/// Whether `find_maps`, for views in this folder, takes a file of this name for disparity or depth
/// that may be true. The file need not exist.
[[nodiscard]] bool is_found_as_truth(const std::filesystem::path& file,
                                     const std::filesystem::path& folder,
                                     const std::optional<SceneFiles>& own = {});

}  // namespace episcope::io
