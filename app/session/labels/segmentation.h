// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/session/labels/live_labeling.h"
#include "engine/core/light_field/label_info.h"
#include "engine/core/light_field/reading.h"
#include "engine/core/parallel/progress.h"
#include "engine/core/parameter/parameter.h"

#include <memory>
#include <vector>

namespace episcope {

/// What becomes of labels before they are shown or written.
struct LabelFinish {
  double smoothing_px = 0;                         ///< See smooth_boundaries.
  std::shared_ptr<const ScribbleLayer> painted{};  ///< Pixels that keep their labels; may be null.
  friend bool operator==(const LabelFinish&, const LabelFinish&) = default;
};

/// A segmentation as files hold it.
struct Segmentation {
  LabelingPtr labeling;           ///< Covers one view or all; not null.
  std::vector<LabelInfo> labels;  ///< Names and colours, by id.
  ParameterSet parameters;        ///< It was made with.
  Reading reading{};              ///< How its light field was read.
  LabelFinish finish{};
};

/// The labels of a view with smooth boundaries, `[y][x]`. Precondition: the labeling covers it.
[[nodiscard]] Image<std::int32_t> finished_labels(const Labeling& labeling,
                                                  const LabelFinish& finish, ViewIndex view);

/// The same of all views that the labeling covers. Throws Cancelled.
[[nodiscard]] ViewStack<std::int32_t> finished_labels(const Labeling& labeling,
                                                      const LabelFinish& finish,
                                                      const Progress& progress);

/// Names and colours of `ids` as far as they are `known`, else defaults.
[[nodiscard]] std::vector<LabelInfo> infos_of(const std::vector<std::int32_t>& ids,
                                              const std::vector<LabelInfo>& known);

}  // namespace episcope
