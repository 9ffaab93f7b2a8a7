// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/parallel/progress.h"
#include "engine/io/beside/beside_views.h"

#include <cstdint>
#include <limits>

namespace episcope::io {

/// Values of a set as stored, of all views of the grid or of the only one that the set holds; in
/// views without a map no pixel is valid. Empty if no file could be read. Throws Cancelled.
[[nodiscard]] DisparityField read_value_set(const MapSet& set, const BesideViews& views,
                                            SetOutcome& outcome, const Progress& progress);

/// Labels of a set as stored, likewise; `kNoMap` in views without a map.
inline constexpr std::int32_t kNoMap = std::numeric_limits<std::int32_t>::min();
struct LabelMaps {
  ViewStack<std::int32_t> numbers;  ///< Labels, or colours as 0xRRGGBB.
  bool are_colors = false;
};
[[nodiscard]] LabelMaps read_label_set(const MapSet& set, const BesideViews& views,
                                       SetOutcome& outcome, const Progress& progress);

/// Marks values that are not finite as invalid and drops a mask in which all is valid.
void tidy_valid(DisparityField& field);

}  // namespace episcope::io
