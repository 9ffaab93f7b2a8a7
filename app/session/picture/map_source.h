// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/session/judge/judge.h"
#include "app/session/labels/segmentation.h"
#include "engine/core/light_field/estimate.h"
#include "engine/core/light_field/ground_truth.h"
#include "engine/core/light_field/label_info.h"
#include "engine/core/light_field/light_field.h"
#include "engine/evaluation/metrics/error_maps.h"
#include "engine/render/quantity.h"
#include "engine/render/shade.h"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace episcope {

/// True labels of the centre view or of all.
using TrueLabelsPtr = std::shared_ptr<const ViewStack<std::int32_t>>;

/// The labels of a ground truth, which they keep alive; null if it has none.
[[nodiscard]] TrueLabelsPtr true_labels_of(const GroundTruthPtr& truth);

/// Everything that a map of one view is made from, held, so that a worker can make it while its
/// owners go on. What the quantity does not need may be null.
struct MapSource {
  render::Quantity quantity = render::Quantity::View;
  ViewIndex view{};
  LightFieldPtr light_field{};
  GroundTruthPtr truth{};
  EstimatePtr estimate{};
  EstimatePtr other{};                              ///< For a difference: estimate − other.
  EvaluationPtr evaluation{};                       ///< Of `estimate` in `view`.
  double bad_threshold_px = kBadPixelThreshold_px;  ///< For BadPixels.
  LabelingPtr labeling{};                ///< For what is of a segmentation, but for Edges.
  LabelFinish finish{};                  ///< Of its labels.
  std::vector<LabelInfo> label_infos{};  ///< Colours of its labels; others have the default ones.
  render::LabelStyle label_style{};      ///< How they are drawn.
  int label = 0;                         ///< Whose probability.
  /// For Edges: EDGE_WEIGHTS of a file, else computed from the image and, if it is known,
  /// disparity.
  std::shared_ptr<const ViewStack<float>> edges{};
  std::shared_ptr<const DisparityField> edge_disparity{};
  TrueLabelsPtr true_labels{};
  friend bool operator==(const MapSource&, const MapSource&) = default;
};

/// Why there is no such map of this view, as a sentence without its full stop; empty if there is
/// one. Preconditions: there is a light field; estimates are there where the quantity is of one.
/// Whether there is an evaluation is not looked at: see `can_judge`.
[[nodiscard]] std::string reason_against(const MapSource& source);

}  // namespace episcope
