// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/scene.h"
#include "engine/io/models/stored_maps.h"

#include <filesystem>
#include <string>
#include <vector>

namespace episcope::io {

/// Writes two PNG for each painted view into an existing folder. `scribbles_<v>_<u>.png` holds the
/// ids (8-bit grey, 16-bit for ids above 255; 0 = unpainted). `scribbles_<v>_<u>_preview.png` holds
/// the colors of the labels on a transparent ground. Views are numbered in canonical order, two
/// digits each. Returns the files written, each of them atomic. Throws IoError.
std::vector<std::filesystem::path> write_scribble_pictures(const std::filesystem::path& folder,
                                                           const Scribbles& scribbles);

/// Whether this is a folder or has the name of a picture, which `read_scribble_pictures` reads.
[[nodiscard]] bool holds_scribble_pictures(const std::filesystem::path& path);

/// Reads a table of the colors that stand for labels: a line `r,g,b,id,name` each, separated by
/// commas, semicolons, tabs or spaces; the name may be missing. Id 0 is the background. Skips a
/// heading, empty lines and those that begin with `#`. Throws IoError, naming the line, for other
/// lines and for a color that stands there twice.
[[nodiscard]] std::vector<LabelInfo> read_color_table(const std::filesystem::path& path);

/// What is known of the labels that pictures show.
struct PictureLabels {
  std::vector<LabelInfo> table{};  ///< As `read_color_table` returns it; empty = none.
  std::vector<LabelInfo> known{};  ///< Labels of the light field.
};

/// Strokes read from pictures.
struct PictureStrokes {
  Scribbles scribbles;             ///< Names and colors of color pictures and palettes included.
  std::vector<std::string> notes;  ///< How pixels were understood, as sentences.
};

/// Most colors of strokes, the background left aside.
inline constexpr std::size_t kMostStrokeColors = 64;

/// Reads every `scribbles_<v>_<u>.png` in a folder, or one picture. A picture belongs to the center
/// view unless its name says another. Unpainted are pixels that are transparent by half or more
/// and, besides:
/// - of gray pictures, whose levels are ids: 0;
/// - of pictures with a palette, whose indices are ids unless a table is given: 0;
/// - of color pictures: those of id 0 in the table; without transparent pixels, unless the table
///   says otherwise or all colors are those of known labels, the most frequent color.
/// A distinct color is a label: of the id that the table gives; without one, of the ids that
/// `known`, or else `label_color`, give if they give one to each color; else counted from 1 in the
/// order of the colors, red first.
/// Throws IoError if there is no picture, if one lies outside the grid or has another size, if
/// nothing is painted, for JPEG, which changes colors, if there are more than `kMostStrokeColors`,
/// and for a color that a given table lacks.
[[nodiscard]] PictureStrokes read_scribble_pictures(const std::filesystem::path& path,
                                                    const FieldShape& shape,
                                                    const PictureLabels& labels = {});

}  // namespace episcope::io
