// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "annotation/document/scribble_layer.h"
#include "engine/labeling/labeler.h"

#include <functional>
#include <memory>

namespace episcope {

using LabelingPtr = std::shared_ptr<const Labeling>;

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

/// A labeler of what the input has besides strokes and parameters, and whether one of `a` serves
/// `b` as well.
[[nodiscard]] Labeler new_labeler(const LabelingInput& input);
[[nodiscard]] bool is_same_scene(const LabelingInput& a, const LabelingInput& b);

/// Whether two inputs give the same labels.
[[nodiscard]] bool is_same(const LabelingInput& a, const LabelingInput& b);

/// What the parameters come to without a disparity: features of images, smoothed view by view.
[[nodiscard]] LabelerParameters possible_parameters(const LabelingInput& input);

/// Segments one view while somebody paints: `on_draft` gets the most probable label of each pixel
/// if smoothing is still to come. `labeler` keeps features between calls and must be that of the
/// input's light field, disparity and edges. The labeling covers the view alone. Throws
/// InvalidInput unless two labels are painted, Cancelled.
[[nodiscard]] LabelingPtr label_live(Labeler& labeler, const LabelingInput& input, ViewIndex view,
                                     const std::function<void(LabelingPtr)>& on_draft,
                                     const Progress& progress);

/// Segments all views. Throws likewise.
[[nodiscard]] LabelingPtr label_all_views(const LabelingInput& input, const Progress& progress);

}  // namespace episcope
