// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/disparity_field.h"
#include "engine/core/image.h"
#include "engine/core/label_info.h"
#include "engine/core/view_stack.h"

#include <cstdint>
#include <filesystem>
#include <string>

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

/// Whether a file holds arrays with names: `.npz`, `.mat`.
[[nodiscard]] bool is_archive_of_maps(const std::filesystem::path& path);

/// Disparity or depth from such a file: the array whose name says so, else one that is named like
/// labels, or the only one with the axes of a map. Of one view, at view (0, 0), or of all views of
/// `grid`, `[v][u][y][x]`. Throws IoError that says what the file holds.
[[nodiscard]] ViewStack<float> read_archived_values(const std::filesystem::path& path,
                                                    GridShape grid);
/// Whether its labels are floats with fractions, and so values. Throws IoError likewise.
[[nodiscard]] bool holds_archived_fractions(const std::filesystem::path& path, GridShape grid);
/// Likewise, labels.
[[nodiscard]] ViewStack<std::int32_t> read_archived_labels(const std::filesystem::path& path,
                                                           GridShape grid);

/// Whether a file of this suffix (.txt, .csv, .dat) begins with a row of eight numbers or more, as
/// matrices do that NumPy, MATLAB and spreadsheets write. Reads the beginning of the file only.
[[nodiscard]] bool is_text_map(const std::filesystem::path& path);
/// By its suffix alone.
[[nodiscard]] bool has_text_suffix(const std::filesystem::path& path);

/// A row of pixels in each line, its numbers separated by blanks, commas or semicolons; empty lines
/// and those that begin with # or % are left out; nan and inf are numbers. Throws IoError for
/// lines of different lengths, for anything else, and for more than 400 MB.
[[nodiscard]] Image<float> read_text_map(const std::filesystem::path& path);

/// How maps of another size were brought to that of the views.
struct ResampledMaps {
  double scale = 1;  ///< Pixels of the map in a pixel of the view; 1 = nothing was done.
  std::string note;  ///< Says so; empty if nothing was done.
};

/// Brings maps whose sides are 2 to 8 times those of the views, or as small a part of them, to the
/// size of the views: of the valid values in a pixel the median (of an even number the larger of
/// the two in the middle: means would lie between surfaces), or each value several times. Values
/// stay as they are, also if they count pixels of the map.
[[nodiscard]] ResampledMaps resample_to(DisparityField& field, int height, int width);

}  // namespace episcope::io
