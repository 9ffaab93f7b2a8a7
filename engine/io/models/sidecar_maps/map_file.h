// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/disparity_field.h"
#include "engine/core/image.h"
#include "engine/core/scene.h"
#include "engine/core/view_stack.h"

#include <cstdint>
#include <filesystem>
#include <string>

namespace episcope::io {

/// Whether files of this suffix can hold disparity or depth as numbers. Pictures (PNG) cannot:
/// nothing states the meaning of their grey levels.
[[nodiscard]] bool can_hold_values(const std::filesystem::path& path);
/// Whether files of this suffix can hold labels: integers, or pictures with a color for each label.
[[nodiscard]] bool can_hold_labels(const std::filesystem::path& path);

/// Reads disparity or depth as stored. Returns one view, at view
/// (0, 0), or all views of `grid`, `[v][u]`, if the file holds as many. Values that are not finite
/// are invalid. Throws IoError.
[[nodiscard]] DisparityField read_values(const std::filesystem::path& path, GridShape grid);

/// Labels as stored, of one view, at view (0, 0), or of all views.
struct StoredLabels {
  ViewStack<std::int32_t> numbers;  ///< Labels, or colors as 0xRRGGBB.
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

/// Files that this program has written: they may lie beside views, but are no truth.
enum class OwnFile { None, Scribbles, Segmentation, Result };
/// Kind of a file of this program. None for files that are no HDF5 files, or that also hold true
/// labels.
[[nodiscard]] OwnFile own_file(const std::filesystem::path& path);

/// Reads an image or array of one view; 1 where it is not 0. Throws IoError.
[[nodiscard]] Image<std::uint8_t> read_mask(const std::filesystem::path& path);

/// Whether a file holds named arrays: `.npz`, `.mat`.
[[nodiscard]] bool is_archive_of_maps(const std::filesystem::path& path);

/// Reads disparity or depth from named arrays: the array with such a name, else one named like
/// labels, or the only one with the axes of a map. Returns one view, at view (0, 0), or all views
/// of `grid`, `[v][u][y][x]`. Throws IoError that says what the file holds.
[[nodiscard]] ViewStack<float> read_archived_values(const std::filesystem::path& path,
                                                    GridShape grid);
/// Whether the labels in named arrays are floats with fractions, and so values. Throws IoError that
/// says what the file holds.
[[nodiscard]] bool holds_archived_fractions(const std::filesystem::path& path, GridShape grid);

/// Scale between maps and views of another size.
struct ResampledMaps {
  double scale = 1;  ///< Pixels of the map in a pixel of the view; 1 = nothing was done.
  std::string note;  ///< Says so; empty if nothing was done.
};

/// Resamples maps whose sides are 2 to 8 times the sides of the views, or as small a fraction, to
/// the size of the views. A larger map gives each pixel the median of its valid values (the larger
/// of the two in the middle: means would lie between surfaces). A smaller map repeats its values.
/// Values stay as they are, even if they count pixels of the map.
[[nodiscard]] ResampledMaps resample_to(DisparityField& field, int height, int width);

}  // namespace episcope::io
