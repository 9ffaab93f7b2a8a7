// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/session/labels/label_statistics.h"
#include "app/session/labels/segmentation.h"
#include "engine/core/light_field/disparity_field.h"
#include "engine/labeling/review/label_doubts.h"
#include "engine/labeling/review/label_pieces.h"

#include <vector>

namespace episcope {

/// What a label is in one view.
struct LabelSummary {
  LabelAmount amount;
  std::vector<LabelPiece> pieces;  ///< As `pieces_of`.

  [[nodiscard]] int count(PieceKind kind) const;
};

/// What there is to check in the labels of a view.
struct ViewReview {
  std::vector<LabelSummary> labels;  ///< Those that the labeling knows, by id.
  std::vector<LabelDoubt> doubts;    ///< As `label_doubts`.
};

/// Reviews a view. `disparity` may be null or cover other views only. Preconditions: labeling and
/// scribbles cover the view. Throws Cancelled.
[[nodiscard]] ViewReview review_view(const Labeling& labeling, const LabelFinish& finish,
                                     ViewIndex view, const ScribbleLayer& painted,
                                     const DisparityField* disparity, const Progress& progress);

}  // namespace episcope
