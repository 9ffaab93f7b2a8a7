// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "annotation/scribble_layer.h"
#include "engine/labeling/labeler.h"

#include <functional>
#include <memory>

namespace episcope {

using LabelingPtr = std::shared_ptr<const Labeling>;

/// What a segmentation goes by: a snapshot that nobody changes.
struct LabelingInput {
  LightFieldPtr light_field;
  std::shared_ptr<const DisparityField> disparity;  ///< Null: images alone.
  std::shared_ptr<const ScribbleLayer> scribbles;
  LabelerParameters parameters;
};

/// Whether two inputs give the same labels.
[[nodiscard]] bool is_same(const LabelingInput& a, const LabelingInput& b);

/// What the parameters come to without a disparity: features of images, smoothed view by view.
[[nodiscard]] LabelerParameters possible_parameters(const LabelingInput& input);

/// Segments one view while somebody paints: `on_draft` gets the most probable label of each pixel
/// if smoothing is still to come. `labeler` keeps features between calls and must be that of the
/// input's light field and disparity. The labeling covers the view alone. Throws InvalidInput
/// unless two labels are painted, Cancelled.
[[nodiscard]] LabelingPtr label_live(Labeler& labeler, const LabelingInput& input, ViewIndex view,
                                     const std::function<void(LabelingPtr)>& on_draft,
                                     const Progress& progress);

/// Segments all views. Throws likewise.
[[nodiscard]] LabelingPtr label_all_views(const LabelingInput& input, const Progress& progress);

}  // namespace episcope
