// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/io/models/names/view_files.h"
#include "engine/io/models/sidecar_maps/map_name.h"

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace episcope::io {

/// Files of one kind, one folder and one form of names, and the views that they belong to.
struct MapSet {
  /// A file, and the number of its view, row by row.
  struct Entry {
    int view = 0;
    std::filesystem::path file;
  };
  MapKind kind = MapKind::Disparity;
  std::string pattern;  ///< "#_#_depth.npy".
  std::vector<Entry> entries;
  /// Files of such names that belong to no view.
  std::vector<std::filesystem::path> strays;
  std::vector<std::filesystem::path> of_left_out{};  ///< Of views that are not in the part opened.
  bool is_named_labels = false;  ///< Disparity whose files are named like labels.

  [[nodiscard]] std::vector<std::filesystem::path> files() const;
  /// The file of this view; empty if there is none.
  [[nodiscard]] std::filesystem::path file_of(int view) const;
};

struct MapsBeside {
  std::vector<MapSet> sets;
  /// Folders that were looked at besides that of the views, and that hold maps.
  std::vector<std::filesystem::path> folders;
};

/// Name of the file beside views in which the Cambridge set for view interpolation states
/// `base_x`, the distance of neighbouring cameras; disparity is stored for a distance of 1.
inline constexpr const char* kBaselineFile = "param.txt";

/// Whether a file may belong to the views, where several light fields share a folder.
using IsOwnFile = std::function<bool(const std::filesystem::path& file)>;

/// Finds maps by their names (`map_kind`), without opening a file: in the folder of the views, in
/// folders inside it (`is_map_folder`), and around it if it is called lf, views or the like or if
/// it has a `kBaselineFile`; and with each view, where each has a folder of its own. Numbers of
/// names are those of the views, or count them row by row; they may begin at another number. A
/// single map without such numbers belongs to the centre view, of a part of a grid to that of the
/// whole. Files that are not `is_own` are as if they were not there. Linear in the files.
[[nodiscard]] MapsBeside find_maps(const ViewFiles& views, const std::filesystem::path& folder,
                                   const IsOwnFile& is_own = {});

}  // namespace episcope::io
