// SPDX-License-Identifier: BSD-3-Clause
#include "app/session/labels/view_review.h"

#include <algorithm>

namespace episcope {
int LabelSummary::count(PieceKind kind) const {
  return static_cast<int>(std::ranges::count(pieces, kind, &LabelPiece::kind));
}

ViewReview review_view(const Labeling& labeling, const LabelFinish& finish, ViewIndex view,
                       const ScribbleLayer& painted, const DisparityField* disparity,
                       const Progress& progress) {
  const Image<std::int32_t> labels = finished_labels(labeling, finish, view);
  const bool has_disparity = disparity && disparity->contains(view);
  const std::vector<LabelAmount> amounts =
      label_amounts(labels, has_disparity ? disparity->view(view) : DisparityView{});
  ViewReview review;
  for (const std::int32_t id : labeling.probabilities.ids) {
    progress.check();
    const auto amount = std::ranges::find(amounts, id, &LabelAmount::id);
    review.labels.push_back(
        {amount == amounts.end() ? LabelAmount{id} : *amount, pieces_of(labels, id)});
  }
  if (!labeling.probabilities.contains(view)) return review;
  progress.check();
  review.doubts = label_doubts(labeling.probabilities.view(view).view(), labeling.probabilities.ids,
                               labels, painted.view(view));
  return review;
}

}  // namespace episcope
