// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/session/labels/live_labeling.h"
#include "engine/core/light_field/label_info.h"
#include "engine/core/parameter/parameter.h"

#include <memory>
#include <vector>

namespace episcope {

/// What is shown of a segmentation.
struct Segmentation {
  LabelingPtr labeling;                             ///< Null = none yet. Covers one view or all.
  bool is_up_to_date = false;                       ///< Whether it is of what is painted now.
  std::vector<LabelInfo> labels;                    ///< Names and colours, by id.
  int label = 0;                                    ///< Whose probability is shown; 0 = none.
  std::shared_ptr<const DisparityField> disparity;  ///< It went by; may be null.
  std::shared_ptr<const ViewStack<float>> edges;    ///< Read from a file; null = computed.
  ParameterSet parameters;                          ///< It was made with.

  [[nodiscard]] bool covers(ViewIndex view) const {
    return labeling && labeling->labels.contains(view);
  }
};

using SegmentationPtr = std::shared_ptr<const Segmentation>;

}  // namespace episcope
