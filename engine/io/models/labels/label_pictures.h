// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/indices.h"
#include "engine/core/scene.h"
#include "engine/io/base/image_file.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace episcope::io {

/// Writes two PNG for each painted view into an existing folder. `scribbles_<v>_<u>.png` holds the
/// ids (8-bit grey, 16-bit for ids above 255; 0 = unpainted). `scribbles_<v>_<u>_preview.png` holds
/// the colors of the labels on a transparent ground. Views are numbered in canonical order, two
/// digits each. Returns the files written, each of them atomic. Throws IoError.
std::vector<std::filesystem::path> write_scribble_pictures(const std::filesystem::path& folder,
                                                           const Scribbles& scribbles);

/// What is known of labels in files of other programs.
struct LabelReading {
  /// Ids and names of colors, as `read_color_table` returns them; empty = none.
  std::vector<LabelInfo> table{};
  /// Labels of the light field.
  std::vector<LabelInfo> known{};
  /// Ids that mean "unlabeled" besides 0 and negative ones. Unset: 255, where other labels are all
  /// smaller.
  std::optional<std::vector<std::int32_t>> ignored{};
  /// Whether 0 is a label: then ids are raised by one, after `ignored` was applied.
  bool zero_is_label = false;
  /// Of a file that holds strokes and true labels, take these.
  bool prefers_truth = false;
  /// Names by colors, for pictures with a palette, whose indices remain the ids.
  std::vector<LabelInfo> palette_names{};
  /// Names and colors by id, as the files state them.
  std::vector<LabelInfo> stated{};
};

/// Labels that were read from files of another program.
struct ImportedLabels {
  Scribbles scribbles;             ///< With names and colors where the files tell them.
  std::vector<std::string> notes;  ///< How pixels were understood, as sentences.
  bool in_order = false;           ///< Only their order in a file tells their views.
};

/// A picture of labels and its view.
struct ViewPicture {
  std::filesystem::path path;
  ViewIndex view;
  LabelPicture picture;
  bool is_own = false;  ///< `write_scribble_pictures` wrote it: then 255 is a label.

  [[nodiscard]] bool is_painted(int y, int x) const;
  [[nodiscard]] Rgb color(int y, int x) const;
};

/// The view that the name of a file of `write_scribble_pictures` states; empty for other names.
[[nodiscard]] std::optional<ViewIndex> view_of_scribble_picture(const std::string& name);

/// Most colors of labels, the background left aside.
inline constexpr std::size_t kMostLabelColors = 64;

/// What pictures of views mean. Unlabeled are pixels that are transparent by half or more and,
/// besides:
/// - of numbers, whose levels are ids: 0;
/// - of pictures with a palette, whose indices are ids unless a table is given: 0;
/// - of color pictures: those of id 0 in the table; without transparent pixels, unless the table
///   says otherwise or all colors are those of known labels, the most frequent color;
/// - ids of `LabelReading::ignored`.
/// A distinct color is a label: of the id that the table gives; without one, of the ids that
/// `known`, or else `label_color`, or else one of `shared_colors`, give if they give one to each
/// color; else counted from 1 in the order of the colors, red first. Colors of Cityscapes must be
/// three at least, black left aside.
/// `path` is for messages. Throws IoError if nothing is painted, for more than `kMostLabelColors`,
/// for a color that a given table lacks, and for colors beside numbers.
[[nodiscard]] ImportedLabels labels_of_pictures(std::vector<ViewPicture> pictures,
                                                const LabelReading& reading,
                                                const std::filesystem::path& path);

}  // namespace episcope::io
