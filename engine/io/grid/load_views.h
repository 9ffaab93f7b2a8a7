// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/light_field/light_field.h"
#include "engine/core/parallel/progress.h"
#include "engine/io/grid/part_of_grid.h"

#include <filesystem>
#include <functional>
#include <optional>
#include <vector>

namespace episcope::io {

/// Image files of the views of a grid, row by row from view (0, 0) on.
struct ViewFiles {
  GridShape grid;
  std::vector<std::filesystem::path> files;
  std::optional<PartOfGrid> part{};               ///< Of a grid with gaps that this is a part of,
  std::vector<std::filesystem::path> left_out{};  ///< and its views that are not in this part.

  int orientation = 1;  ///< In which all of them are to be shown (`common_orientation`).

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

}  // namespace episcope::io
