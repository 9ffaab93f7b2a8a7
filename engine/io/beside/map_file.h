// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/array/image.h"
#include "engine/core/light_field/disparity_field.h"
#include "engine/core/light_field/label_info.h"

#include <cstdint>
#include <filesystem>

namespace episcope::io {

/// Whether files of this suffix can hold disparity or depth as numbers; pictures (PNG) cannot:
/// nothing states what their grey levels mean.
[[nodiscard]] bool can_hold_values(const std::filesystem::path& path);
/// Whether they can hold labels: integers, or pictures of a colour for each label.
[[nodiscard]] bool can_hold_labels(const std::filesystem::path& path);

/// Disparity or depth as stored, or the levels of a grey picture: of one view, at view (0, 0), or
/// of all views of `grid`, `[v][u]`, where the file holds as many. Values that are not finite are
/// invalid. Throws IoError.
[[nodiscard]] DisparityField read_values(const std::filesystem::path& path, GridShape grid);

/// Labels as stored, of one view, at view (0, 0), or of all views.
struct StoredLabels {
  ViewStack<std::int32_t> numbers;  ///< Labels, or colours as 0xRRGGBB.
  bool are_colors = false;
};
/// Throws IoError.
[[nodiscard]] StoredLabels read_stored_labels(const std::filesystem::path& path, GridShape grid);

[[nodiscard]] constexpr std::int32_t packed(Rgb color) {
  return (color[0] << 16) | (color[1] << 8) | color[2];
}
[[nodiscard]] constexpr Rgb unpacked(std::int32_t color) {
  return {static_cast<std::uint8_t>(color >> 16), static_cast<std::uint8_t>(color >> 8),
          static_cast<std::uint8_t>(color)};
}

/// What this program has written itself may lie beside views too, and is no truth.
enum class OwnFile { None, Scribbles, Segmentation, Result };
/// None for files that are no HDF5 files, or that hold true labels as well.
[[nodiscard]] OwnFile own_file(const std::filesystem::path& path);

/// What is not 0 in an image or array of one view. Throws IoError.
[[nodiscard]] Image<std::uint8_t> read_mask(const std::filesystem::path& path);

}  // namespace episcope::io
