// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "annotation/scribble_layer.h"
#include "engine/core/ground_truth.h"
#include "engine/core/label_info.h"
#include "engine/core/parameter.h"
#include "engine/core/progress.h"
#include "engine/labeling/labeler.h"

#include <functional>
#include <memory>
#include <vector>

namespace episcope {

using LabelingPtr = std::shared_ptr<const Labeling>;

/// True labels of the center view or of all views.
using TrueLabelsPtr = std::shared_ptr<const ViewStack<std::int32_t>>;

/// The labels of a ground truth, which they keep alive; null if it has none.
[[nodiscard]] TrueLabelsPtr true_labels_of(const GroundTruthPtr& truth);

/// The input of a segmentation: an immutable snapshot.
struct LabelingInput {
  LightFieldPtr light_field;
  std::shared_ptr<const DisparityField> disparity;  ///< Null: images alone.
  /// EDGE_WEIGHTS of all views; null: computed from image and disparity.
  std::shared_ptr<const ViewStack<float>> edges;
  std::shared_ptr<const ScribbleLayer> scribbles;
  LabelerParameters parameters;
  /// Of the disparity (LabelingDisparity::confidence); null: it is right everywhere.
  std::shared_ptr<const ViewStack<float>> confidence;
};

/// Makes a labeler from the input without its strokes and parameters; `is_same_scene` tells whether
/// a labeler made for `a` also serves `b`.
[[nodiscard]] Labeler new_labeler(const LabelingInput& input);
[[nodiscard]] bool is_same_scene(const LabelingInput& a, const LabelingInput& b);

/// Whether two inputs give the same labels.
[[nodiscard]] bool is_same(const LabelingInput& a, const LabelingInput& b);

/// The parameters that the input allows: without a disparity, features of images and smoothing view
/// by view.
[[nodiscard]] LabelerParameters possible_parameters(const LabelingInput& input);

/// Segments one view while somebody paints: `on_draft` gets the most probable label of each pixel
/// if smoothing is still to come. `labeler` keeps features between calls; it must have been made
/// for the input's light field, disparity and edges. The labeling covers the view alone. Throws
/// InvalidInput unless two labels are painted, Cancelled.
[[nodiscard]] LabelingPtr label_live(Labeler& labeler, const LabelingInput& input, ViewIndex view,
                                     const std::function<void(LabelingPtr)>& on_draft,
                                     const Progress& progress);

/// Segments all views. Throws as `label_live`.
[[nodiscard]] LabelingPtr label_all_views(const LabelingInput& input, const Progress& progress);

/// Post-processing of labels before they are shown or written.
struct LabelFinish {
  double smoothing_px = 0;                         ///< See smooth_boundaries.
  std::shared_ptr<const ScribbleLayer> painted{};  ///< Pixels that keep their labels; may be null.
  friend bool operator==(const LabelFinish&, const LabelFinish&) = default;
};

/// A segmentation as files hold it.
struct Segmentation {
  LabelingPtr labeling;           ///< Covers one view or all; not null.
  std::vector<LabelInfo> labels;  ///< Names and colors, by id.
  ParameterSet parameters;        ///< It was made with.
  Reading reading{};              ///< How its light field was read.
  LabelFinish finish{};
};

/// The labels of a view with smooth boundaries, `[y][x]`. Precondition: the labeling covers it.
[[nodiscard]] Image<std::int32_t> finished_labels(const Labeling& labeling,
                                                  const LabelFinish& finish, ViewIndex view);

/// The labels of all views that the labeling covers, with smooth boundaries. Throws Cancelled.
[[nodiscard]] ViewStack<std::int32_t> finished_labels(const Labeling& labeling,
                                                      const LabelFinish& finish,
                                                      const Progress& progress);

/// Names and colors of `ids`: from `known`, else defaults.
[[nodiscard]] std::vector<LabelInfo> infos_of(const std::vector<std::int32_t>& ids,
                                              const std::vector<LabelInfo>& known);

}  // namespace episcope
