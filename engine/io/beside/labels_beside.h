// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/light_field/label_info.h"
#include "engine/core/parallel/progress.h"
#include "engine/io/beside/beside_views.h"

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

}  // namespace episcope::io
