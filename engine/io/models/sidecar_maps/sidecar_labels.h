// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/label_info.h"
#include "engine/core/progress.h"
#include "engine/core/view_stack.h"
#include "engine/io/models/sidecar_maps/find_maps.h"
#include "engine/io/models/sidecar_maps/map_sets.h"

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace episcope::io {

/// Labels found beside views, ids from 1 on, 0 = none, in the stored order of views.
struct LabelsBeside {
  ViewStack<std::int32_t> labels;  ///< Of all views or of one; empty = none.
  std::vector<LabelInfo> infos;    ///< Names and colours, as far as they are known.
};

/// Reads labels from arrays, images of integers or pictures of a colour for each label. Where both
/// numbers and a picture are there, numbers count, and the picture tells colours and whether ids
/// begin at 0. A raise is noted in the report. Throws Cancelled.
[[nodiscard]] LabelsBeside read_labels_beside(const std::vector<MapSet>& sets,
                                              const BesideViews& views, const BesideNotes& notes,
                                              const Progress& progress);

/// Labels as the engine has them: ids from 1 on, 0 = none.
struct LabelMeaning {
  std::vector<LabelInfo> infos;     ///< Names and colours, as far as they are known, by id.
  bool raised = false;              ///< Stored ids began at 0 and were raised by one.
  std::string kind = "label maps";  ///< Or "UrbanLF label maps", "coloured label maps".
};

/// What else is known of stored labels.
struct LabelHints {
  bool is_urban_name = false;  ///< Files are called as in UrbanLF,
  bool is_urban_size = false;  ///< and the views have the size of one of its parts.
  /// The same labels of one view as colours 0xRRGGBB; empty = none.
  ViewStack<std::int32_t> colors;
};

/// Replaces colours by ids: those of UrbanLF if all of them are colours of its classes; else one id
/// for each colour, by its value, black = none. Empty if there are more than 256 colours, which no
/// picture of labels has. Linear in the pixels.
[[nodiscard]] std::optional<LabelMeaning> name_colors(ViewStack<std::int32_t>& labels);

/// Brings stored numbers into the engine's form: −1 (or another negative number) and 255 beside
/// smaller labels are none. They are raised by one where 0 is a label: colours say so, or another
/// number marks what has none, or an UrbanLF scene has labels 0 … 13 and not 1 … 14.
[[nodiscard]] LabelMeaning name_numbers(ViewStack<std::int32_t>& labels, const LabelHints& hints);

/// The 14 classes of UrbanLF with their names and colours, ids from 1 on. Source: Sheng et al. 2022
/// (UrbanLF), table of classes.
[[nodiscard]] std::span<const LabelInfo> urban_classes();

/// The class of this colour; 0 if there is none. Black is the class "others".
[[nodiscard]] int urban_class_of(Rgb color);

/// Files of `.npy`, `.npz`, `.mat` and HDF5 that are named like labels and hold floats with
/// fractions hold disparity, as EPINET names it: their sets become sets of disparity, or are left
/// out where there is disparity under its own name. One file of each set is looked at.
void settle_fractional_labels(std::vector<MapSet>& sets, const BesideViews& views,
                              const BesideNotes& notes);

}  // namespace episcope::io
