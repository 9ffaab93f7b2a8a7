// SPDX-License-Identifier: BSD-3-Clause
#include "app/session/labels/view_review.h"

#include <algorithm>
#include <cmath>

namespace episcope {
namespace {

void measure(const Image<std::int32_t>& labels, const DisparityField* disparity, ViewIndex view,
             LabelSummary& summary) {
  const bool has_disparity = disparity && disparity->contains(view);
  const ImageView<const float> map =
      has_disparity ? disparity->disparity.view(view) : ImageView<const float>{};
  const ImageView<const std::uint8_t> valid = has_disparity && !disparity->valid.empty()
                                                  ? disparity->valid.view(view)
                                                  : ImageView<const std::uint8_t>{};
  std::int64_t measured = 0;
  double sum = 0;
  double squares = 0;
  for (int y = 0; y < labels.height(); ++y) {
    for (int x = 0; x < labels.width(); ++x) {
      if (labels.at(y, x) != summary.id) continue;
      ++summary.pixels;
      if (!has_disparity || (!valid.empty() && valid.at(y, x) == 0)) continue;
      const double value = map.at(y, x);
      if (!std::isfinite(value)) continue;
      ++measured;
      sum += value;
      squares += value * value;
    }
  }
  if (measured == 0) return;
  const double mean = sum / static_cast<double>(measured);
  summary.mean_disparity_px = mean;
  summary.disparity_deviation_px =
      std::sqrt(std::max(0.0, squares / static_cast<double>(measured) - mean * mean));
}

}  // namespace

int LabelSummary::count(PieceKind kind) const {
  return static_cast<int>(std::ranges::count(pieces, kind, &LabelPiece::kind));
}

ViewReview review_view(const Labeling& labeling, const LabelFinish& finish, ViewIndex view,
                       const ScribbleLayer& painted, const DisparityField* disparity,
                       const Progress& progress) {
  const Image<std::int32_t> labels = finished_labels(labeling, finish, view);
  ViewReview review;
  for (const std::int32_t id : labeling.probabilities.ids) {
    progress.check();
    LabelSummary summary;
    summary.id = id;
    summary.pieces = pieces_of(labels, id);
    measure(labels, disparity, view, summary);
    review.labels.push_back(std::move(summary));
  }
  if (!labeling.probabilities.contains(view)) return review;
  progress.check();
  review.doubts = label_doubts(labeling.probabilities.view(view).view(), labeling.probabilities.ids,
                               labels, painted.view(view));
  return review;
}

}  // namespace episcope
