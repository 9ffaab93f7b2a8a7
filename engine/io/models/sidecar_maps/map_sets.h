// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/disparity_field.h"
#include "engine/core/light_field.h"
#include "engine/core/progress.h"
#include "engine/io/models/assemble_scene.h"
#include "engine/io/models/open_options.h"
#include "engine/io/models/sidecar_maps/find_maps.h"
#include "engine/io/models/sidecar_maps/map_file.h"

#include <cstdint>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace episcope::io {

/// Views, as stored, beside which maps lie.
struct SidecarViews {
  const ViewFiles& files;
  std::filesystem::path folder;  ///< Of the views.
  const LightField::Samples& samples;
  CameraGrid camera;  ///< Known fields only.
  MapViews map_views = MapViews::All;
  bool needs_truth = true;
  bool is_shift_unknown = false;    ///< Views may be shifted against what `camera` says.
  std::optional<SceneFiles> own{};  ///< Which files may belong to the views; empty = all.

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

/// Sets of one kind. `fit` holds those that `can_hold` the wanted data: sets that claim to be true
/// first, then those of most views, arrays before images, and images before text. `unfit` holds the
/// others.
struct RankedSets {
  std::vector<const MapSet*> fit;
  std::vector<const MapSet*> unfit;
};
[[nodiscard]] RankedSets rank_sets(const std::vector<MapSet>& sets, MapKind kind,
                                   bool (*can_hold)(const std::filesystem::path&));

/// Warns that one set is used and another is not whose names claim as much; not if they are forms
/// of one map.
void tell_equal_names(const MapSet& used, const MapSet& other, ConventionReport& report);

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
