// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/image.h"
#include "engine/core/progress.h"
#include "engine/core/scene.h"
#include "engine/core/view_stack.h"

#include <cstdint>
#include <map>
#include <optional>
#include <utility>
#include <vector>

namespace episcope {

/// Which true label each given one stands for; others stand for none.
struct LabelMatch {
  std::map<std::int32_t, std::int32_t> true_of;
  bool is_by_overlap = false;  ///< Whether numbers differ and names did not tell.
};

/// How often labels agree with the ground truth.
struct LabelAccuracy {
  /// Pixels by true label and given label.
  std::map<std::pair<std::int32_t, std::int32_t>, std::int64_t> confusion;

  [[nodiscard]] std::int64_t judged() const;
  /// Fraction of the evaluated pixels with the correct label, in [0, 1]; empty if there are none.
  [[nodiscard]] std::optional<double> share() const;
  /// Share of correct pixels among the pixels of one true label.
  [[nodiscard]] std::optional<double> share(std::int32_t label) const;

  /// Mean over the true labels of `share(label)` ("mAcc"); empty if nothing was judged.
  [[nodiscard]] std::optional<double> mean_share() const;
  /// Intersection over union of the pixels that have the label and of those given it, among judged
  /// pixels; empty for no true label.
  [[nodiscard]] std::optional<double> overlap(std::int32_t label) const;
  /// Mean of it over the true labels ("mIoU"); empty if nothing was judged.
  [[nodiscard]] std::optional<double> mean_overlap() const;
  /// The true labels, ascending.
  [[nodiscard]] std::vector<std::int32_t> labels() const;

  LabelAccuracy& operator+=(const LabelAccuracy& other);
  /// With given labels replaced by the true ones that they stand for.
  [[nodiscard]] LabelAccuracy matched(const LabelMatch& match) const;
};

/// Matches labels of two numberings one to one: those with the same name, then the others by the
/// largest overlap. `accuracy`: of the numbers as they are.
[[nodiscard]] LabelMatch match_labels(const LabelAccuracy& accuracy,
                                      const std::vector<LabelInfo>& given,
                                      const std::vector<LabelInfo>& truth);

/// Judges one view. Pixels without a true label (0 or less) are not judged. Throws InvalidInput if
/// the sizes differ.
[[nodiscard]] LabelAccuracy judge_labels(ImageView<const std::int32_t> labels,
                                         ImageView<const std::int32_t> truth);

/// Judges every view that both stacks cover.
[[nodiscard]] LabelAccuracy judge_labels(const ViewStack<std::int32_t>& labels,
                                         const ViewStack<std::int32_t>& truth);

/// Within how many px of a true boundary labels count as near it.
inline constexpr int kBoundaryBand_px = 3;
/// Up to how many px something is thin.
inline constexpr int kThinWidth_px = 4;

/// Scores of labels that a single share of correct pixels hides.
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
