// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/progress.h"
#include "engine/core/scene.h"
#include "engine/core/view_stack.h"
#include "engine/io/models/sidecar_maps/map_sets.h"

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace episcope::io {

/// Labels found beside views, ids from 1 on, 0 = none, in the stored order of views.
struct SidecarLabels {
  ViewStack<std::int32_t> labels;  ///< Of all views or of one; empty = none.
  std::vector<LabelInfo> infos;    ///< Names and colors, if known.
};

/// Reads labels from arrays, images of integers, or pictures with a color for each label. If there
/// are both numbers and a picture, the numbers count, and the picture tells colors and whether ids
/// begin at 0. Reports if ids were raised. Throws Cancelled.
[[nodiscard]] SidecarLabels read_sidecar_labels(const std::vector<MapSet>& sets,
                                                const SidecarViews& views,
                                                const SidecarNotes& notes,
                                                const Progress& progress);

/// Labels as the engine has them: ids from 1 on, 0 = none.
struct LabelMeaning {
  std::vector<LabelInfo> infos;     ///< Names and colors by id, if known.
  bool raised = false;              ///< Stored ids began at 0 and were raised by one.
  std::string kind = "label maps";  ///< Or "UrbanLF label maps", "colored label maps".
};

/// Other facts about stored labels.
struct LabelHints {
  bool is_urban_name = false;  ///< Files are called as in UrbanLF,
  bool is_urban_size = false;  ///< and the views have the size of one of its parts.
  /// Labels of one view as colors 0xRRGGBB; empty = none.
  ViewStack<std::int32_t> colors;
};

/// Replaces colors by ids: ids of UrbanLF if all are colors of its classes; else one id for each
/// color, by its value, black = none. Empty for more than 256 colors, which no picture of labels
/// has. Linear in the pixels.
[[nodiscard]] std::optional<LabelMeaning> name_colors(ViewStack<std::int32_t>& labels);

/// Brings stored numbers into the form of the engine. Negative numbers, and 255 beside smaller
/// labels, are none. Ids are raised by one if 0 is a label: if colors say so, if another number
/// marks unlabeled pixels, or if an UrbanLF scene has labels 0 … 13 and not 1 … 14.
[[nodiscard]] LabelMeaning name_numbers(ViewStack<std::int32_t>& labels, const LabelHints& hints);

/// The 14 classes of UrbanLF with their names and colors, ids from 1 on. Source: Sheng et al. 2022
/// (UrbanLF), table of classes.
[[nodiscard]] std::span<const LabelInfo> urban_classes();

/// Class of this color; 0 if there is none. Black is the class "others".
[[nodiscard]] int urban_class_of(Rgb color);

/// Treats label files with fractional floats (`.npy`, `.npz`, `.mat`, HDF5) as disparity, as EPINET
/// names it. Their sets become sets of disparity, or are left out if there is disparity under its
/// own name. Examines one file of each set.
void settle_fractional_labels(std::vector<MapSet>& sets, const SidecarViews& views,
                              const SidecarNotes& notes);

}  // namespace episcope::io
