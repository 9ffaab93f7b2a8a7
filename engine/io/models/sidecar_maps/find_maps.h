// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/light_field.h"
#include "engine/core/progress.h"
#include "engine/core/scene.h"
#include "engine/io/models/assemble_scene.h"
#include "engine/io/models/names/view_files.h"
#include "engine/io/models/open_options.h"
#include "engine/io/models/sidecar_maps/map_file.h"
#include "engine/io/models/sidecar_maps/map_name.h"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <limits>
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

  [[nodiscard]] std::vector<std::filesystem::path> files() const;
  /// File of this view; empty if there is none.
  [[nodiscard]] std::filesystem::path file_of(int view) const;
};

struct FoundMapSets {
  std::vector<MapSet> sets;
  /// Other folders that were searched and hold maps.
  std::vector<std::filesystem::path> folders;
};

/// File beside views in which the Cambridge set for view interpolation states `base_x`, the
/// distance of neighboring cameras. Its disparity refers to a distance of 1.
inline constexpr const char* kBaselineFile = "param.txt";

/// Whether a file may belong to the views, where several light fields share a folder.
using IsOwnFile = std::function<bool(const std::filesystem::path& file)>;

/// Finds maps by their names (`map_kind`), without opening a file. Searches the folder of the views
/// and folders inside it (`is_map_folder`). Searches around it if it is called lf, views or the
/// like or has a `kBaselineFile`. Searches beside each view if each has a folder of its own.
/// Numbers in names match the numbers of the views, or count the views row by row from any number.
/// A single map without such numbers belongs to the center view of the whole grid. Ignores files
/// that are not `is_own`. Linear in the files.
[[nodiscard]] FoundMapSets find_maps(const ViewFiles& views, const std::filesystem::path& folder,
                                     const IsOwnFile& is_own = {});

/// Views, as stored, beside which maps lie.
struct SidecarViews {
  const ViewFiles& files;
  std::filesystem::path folder;  ///< Of the views.
  const LightField::Samples& samples;
  CameraGrid camera;  ///< Known fields only.
  MapViews map_views = MapViews::All;
  bool needs_truth = true;
  bool is_shift_unknown = false;  ///< Views may be shifted against what `camera` says.
  IsOwnFile is_own{};             ///< Which files may belong to the views; empty = all.

  [[nodiscard]] GridShape grid() const { return files.grid; }
  [[nodiscard]] int height() const;
  [[nodiscard]] int width() const;
  [[nodiscard]] int center() const {  ///< Number of the center view.
    const ViewIndex center = grid().center();
    return center.v * grid().u + center.u;
  }
};

/// Records of the readers of maps.
struct SidecarNotes {
  FileUsage& account;
  ConventionReport& report;
};

/// Result of reading the files of a set.
struct SetOutcome {
  std::vector<std::filesystem::path> read;
  std::vector<std::filesystem::path> failed;
  std::string first_error;  ///< A sentence that names the file.
  std::string note;         ///< A sentence on how maps of another size were fitted, or empty.
  double map_scale = 1;     ///< Pixels of such a map in a pixel of the view.

  void take(const ResampledMaps& fitted) {
    note = fitted.note;
    map_scale = fitted.scale;
  }

  /// Records the files and adds a warning if files failed or were resampled.
  void tell(const std::string& kind, const SidecarNotes& notes) const;
};

/// Throws IoError unless a map has the size of the views.
void require_view_size(const std::filesystem::path& path, int height, int width,
                       const SidecarViews& views);

/// The entries to read: all, or the one of the center view or of the first view.
[[nodiscard]] std::vector<MapSet::Entry> entries_to_read(const MapSet& set,
                                                         const SidecarViews& views);

/// Sets of one kind. `fit` holds those that `can_hold` the wanted data: sets of most views first,
/// then arrays before images, and images before text. `unfit` holds the others.
struct RankedSets {
  std::vector<const MapSet*> fit;
  std::vector<const MapSet*> unfit;
};
[[nodiscard]] RankedSets rank_sets(const std::vector<MapSet>& sets, MapKind kind,
                                   bool (*can_hold)(const std::filesystem::path&));

/// Reads the stored values of a set, of all views or of the only one that the set holds. Pixels of
/// views without a map are invalid. Empty if no file could be read. Throws Cancelled.
[[nodiscard]] DisparityField read_value_set(const MapSet& set, const SidecarViews& views,
                                            SetOutcome& outcome, const Progress& progress);

/// Label of pixels in views without a map.
inline constexpr std::int32_t kNoMap = std::numeric_limits<std::int32_t>::min();
/// Stored labels; `kNoMap` in views without a map.
struct LabelMaps {
  ViewStack<std::int32_t> numbers;  ///< Labels, or colors as 0xRRGGBB.
  bool are_colors = false;
};
/// Reads the stored labels of a set, of all views or of the only one that the set holds. Throws
/// Cancelled.
[[nodiscard]] LabelMaps read_label_set(const MapSet& set, const SidecarViews& views,
                                       SetOutcome& outcome, const Progress& progress);

/// Marks values that are not finite as invalid and drops a mask without invalid pixels.
void tidy_valid(DisparityField& field);

}  // namespace episcope::io
