// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/array/view_stack.h"

#include <cstdint>
#include <map>
#include <optional>
#include <utility>
#include <vector>

namespace episcope {

/// How often labels agree with the ground truth.
struct LabelAccuracy {
  /// Pixels by true label and given label.
  std::map<std::pair<std::int32_t, std::int32_t>, std::int64_t> confusion;

  [[nodiscard]] std::int64_t judged() const;
  /// Fraction of the evaluated pixels with the correct label, in [0, 1]; empty if there are none.
  [[nodiscard]] std::optional<double> share() const;
  /// The same among pixels of one true label.
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
};

/// Judges one view. Pixels without a true label (0 or less) are not judged. Throws InvalidInput if
/// the sizes differ.
[[nodiscard]] LabelAccuracy judge_labels(ImageView<const std::int32_t> labels,
                                         ImageView<const std::int32_t> truth);

/// Judges every view that both stacks cover.
[[nodiscard]] LabelAccuracy judge_labels(const ViewStack<std::int32_t>& labels,
                                         const ViewStack<std::int32_t>& truth);

}  // namespace episcope
