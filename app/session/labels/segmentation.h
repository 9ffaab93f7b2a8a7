// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/session/labels/live_labeling.h"
#include "engine/core/light_field/label_info.h"
#include "engine/core/light_field/reading.h"
#include "engine/core/parameter/parameter.h"

#include <vector>

namespace episcope {

/// A segmentation as files hold it.
struct Segmentation {
  LabelingPtr labeling;           ///< Covers one view or all; not null.
  std::vector<LabelInfo> labels;  ///< Names and colours, by id.
  ParameterSet parameters;        ///< It was made with.
  Reading reading{};              ///< How its light field was read.
};

}  // namespace episcope
