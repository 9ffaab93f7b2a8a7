// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/array/view_stack.h"
#include "engine/core/light_field/label_info.h"
#include "engine/io/beside/read_set.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace episcope::io {

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

}  // namespace episcope::io
