// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/array/image.h"
#include "engine/core/parallel/progress.h"
#include "engine/evaluation/metrics/label_accuracy.h"

#include <cstdint>
#include <map>
#include <optional>

namespace episcope {

/// Within how many px of a true boundary labels count as near it.
inline constexpr int kBoundaryBand_px = 3;
/// Up to how many px something is thin.
inline constexpr int kThinWidth_px = 4;

/// 1 where a pixel of another label lies in the square of 2·radius + 1 px around the pixel,
/// `[y][x]`.
[[nodiscard]] Image<std::uint8_t> near_boundaries(ImageView<const std::int32_t> labels, int radius);

/// 1 where the pixel lies in no square of kThinWidth_px + 1 px of its label alone, `[y][x]`: what a
/// morphological opening of the label removes. Squares end at the border of the image.
[[nodiscard]] Image<std::uint8_t> thin_parts(ImageView<const std::int32_t> labels);

/// What one number for all pixels does not show of labels.
struct LabelQuality {
  LabelAccuracy all;         ///< Of every pixel with a true label,
  LabelAccuracy boundaries;  ///< and of those within kBoundaryBand_px of a true boundary.
  std::map<std::int32_t, std::int64_t> thin;  ///< Pixels of thin parts, by true label.

  /// Mean intersection over union of the labels most of whose pixels are thin; empty if none are.
  [[nodiscard]] std::optional<double> thin_overlap() const;

  LabelQuality& operator+=(const LabelQuality& other);
};

/// Judges one view, or every view that both stacks cover. Pixels without a true label (0 or less)
/// are not judged, but count as another label beside a boundary. Throws InvalidInput if the sizes
/// differ, Cancelled.
[[nodiscard]] LabelQuality judge_label_quality(ImageView<const std::int32_t> labels,
                                               ImageView<const std::int32_t> truth);
[[nodiscard]] LabelQuality judge_label_quality(const ViewStack<std::int32_t>& labels,
                                               const ViewStack<std::int32_t>& truth,
                                               const Progress& progress);

}  // namespace episcope
