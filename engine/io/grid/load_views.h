// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/light_field/light_field.h"
#include "engine/core/parallel/progress.h"
#include "engine/io/grid/part_of_grid.h"

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace episcope::io {

/// Image files of the views of a grid, row by row from view (0, 0) on.
struct ViewFiles {
  GridShape grid;
  std::vector<std::filesystem::path> files;
  std::optional<PartOfGrid> part{};               ///< Of a grid with gaps that this is a part of,
  std::vector<std::filesystem::path> left_out{};  ///< and its views that are not in this part,
  std::vector<std::filesystem::path> unusable{};  ///< or that `load_usable_views` could not use.

  int orientation = 1;  ///< In which all of them are to be shown (`common_orientation`).

  [[nodiscard]] const std::filesystem::path& file(ViewIndex view) const {
    return files[static_cast<std::size_t>(view.v) * grid.u + view.u];
  }
  /// With the views that are missing or left out.
  [[nodiscard]] GridShape whole_grid() const { return part ? part->whole : grid; }
  /// The place in the whole grid of a view, and where the centre of that grid is; nothing if it is
  /// missing or left out.
  [[nodiscard]] ViewIndex in_whole(ViewIndex view) const {
    return part ? part->in_whole(view) : view;
  }
  [[nodiscard]] std::optional<ViewIndex> whole_center() const {
    return part ? part->in_part(part->whole.center()) : std::optional(grid.center());
  }
};

/// Called with an 8-bit RGB picture of the centre view before the others are read.
using OnCenterView = std::function<void(const Image<std::uint8_t>& center_rgb)>;

/// Decodes the views in parallel, upright, the centre first. Throws IoError that names the file if
/// one cannot be decoded or differs in size, channels or depth from the centre view; Cancelled.
[[nodiscard]] LightField::Samples load_views(const ViewFiles& views, const OnCenterView& on_center,
                                             const Progress& progress);

/// Samples of those views of a grid that can be used together.
struct UsableViews {
  LightField::Samples samples;
  ViewFiles views;                   ///< All, or the part of them that `samples` holds.
  std::optional<PartOfGrid> kept{};  ///< That part, if it is not all.
  std::string warning{};             ///< What could not be used and why, and what is left.
};

/// The same for folders in which some files are damaged, or of another size or depth than most:
/// these are as good as missing, and the largest part without them is kept (`without_views`).
/// Throws IoError about the first of them if there is no such part; Cancelled.
[[nodiscard]] UsableViews load_usable_views(const ViewFiles& views, const OnCenterView& on_center,
                                            const Progress& progress);

}  // namespace episcope::io
