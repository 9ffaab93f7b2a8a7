// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/light_field/disparity_field.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace episcope {

/// Disparities of the pixels of a label, px.
struct LabelDisparity {
  double mean = 0;
  double deviation = 0;  ///< Standard deviation.
  double min = 0;
  double max = 0;
};

/// How much of a view has a label.
struct LabelAmount {
  std::int32_t id = 0;
  std::int64_t pixels = 0;
  std::optional<LabelDisparity> disparity{};  ///< None if no pixel has one.
};

/// The labels of a view `[y][x]` that are above 0, by id, in one pass over its pixels. `disparity`
/// is of the same view; empty = unknown.
[[nodiscard]] std::vector<LabelAmount> label_amounts(ImageView<const std::int32_t> labels,
                                                     const DisparityView& disparity);
/// The same of painted labels.
[[nodiscard]] std::vector<LabelAmount> label_amounts(ImageView<const std::uint8_t> labels,
                                                     const DisparityView& disparity);

}  // namespace episcope
