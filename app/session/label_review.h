// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/session/picture.h"
#include "app/session/segmentation.h"
#include "engine/core/disparity_field.h"
#include "engine/core/light_field.h"
#include "engine/core/progress.h"
#include "engine/core/scene.h"
#include "engine/evaluation/label_quality.h"
#include "engine/evaluation/metrics.h"
#include "engine/labeling/label_review.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace episcope {

/// How good labels are. Scores are empty where there is no truth.
struct LabelingScores {
  LabelQuality view;       ///< Of one view; judges nothing without true labels of it.
  LabelQuality all_views;  ///< Of all views; judges nothing without true labels of all.
  /// Share of rays that agree with the rays of the same scene point, in [0, 1]; none if one view
  /// alone is labeled or the rays are not known.
  std::optional<double> consistency;
  bool is_by_overlap = false;  ///< Labels were matched by overlap (match_labels).
};

/// Judges labels against `truth`, which may be empty or hold one view alone. Rays are followed
/// along the true disparity where all views have one, else along `disparity`, which may be null.
/// Throws InvalidInput if sizes differ, Cancelled.
[[nodiscard]] LabelingScores judge_labeling(const ViewStack<std::int32_t>& labels, ViewIndex view,
                                            const ViewStack<std::int32_t>& truth,
                                            const GroundTruth& ground_truth,
                                            const DisparityField* disparity,
                                            const Progress& progress);

/// Scores of labels whose numbers may differ from the true ones (match_labels).
[[nodiscard]] LabelingScores matched(LabelingScores scores, const std::vector<LabelInfo>& given,
                                     const std::vector<LabelInfo>& truth);

/// Sentence with both numbers if far more is right once labels are matched by overlap, as after
/// strokes whose numbers were chosen anew; else empty.
[[nodiscard]] std::string other_numbers_text(const LabelingScores& scores);

/// What speaks against strokes beside true labels, which may be empty, a sentence each: painted ids
/// that these do not have, true ids that nobody painted, and that few painted pixels have their
/// true label.
[[nodiscard]] std::vector<std::string> stroke_notes(const Scribbles& scribbles,
                                                    const ViewStack<std::int32_t>& truth);

/// Says that few painted pixels have their label as the most probable one, as by probabilities of
/// other labels, views or pixels; else empty.
[[nodiscard]] std::string probabilities_note(const LabelProbabilities& probabilities,
                                             const Scribbles& scribbles);

/// The scores that are known, by key: shares in [0, 1].
[[nodiscard]] Metrics labeling_metrics(const LabelingScores& scores);

/// Disparities of the pixels of a label, px.
struct LabelDisparity {
  double mean = 0;
  double deviation = 0;  ///< Standard deviation.
  double min = 0;
  double max = 0;
};

/// How much of a view has a label.
struct LabelAmount {
  std::int32_t id = 0;
  std::int64_t pixels = 0;
  std::optional<LabelDisparity> disparity{};  ///< None if no pixel has one.
};

/// The labels of a view `[y][x]` that are above 0, by id, in one pass over its pixels. `disparity`
/// is of the same view; empty = unknown.
[[nodiscard]] std::vector<LabelAmount> label_amounts(ImageView<const std::int32_t> labels,
                                                     const DisparityView& disparity);
/// Amounts of painted labels.
[[nodiscard]] std::vector<LabelAmount> label_amounts(ImageView<const std::uint8_t> labels,
                                                     const DisparityView& disparity);

struct LabelSummary {
  LabelAmount amount;
  std::vector<LabelPiece> pieces;  ///< As `pieces_of`.

  [[nodiscard]] int count(PieceKind kind) const;
};

/// What to check in the labels of a view.
struct ViewReview {
  std::vector<LabelSummary> labels;  ///< Those that the labeling knows, by id.
  std::vector<LabelDoubt> doubts;    ///< As `label_doubts`.
};

/// Reviews a view. `disparity` may be null or cover other views only. Preconditions: labeling and
/// scribbles cover the view. Throws Cancelled.
[[nodiscard]] ViewReview review_view(const Labeling& labeling, const LabelFinish& finish,
                                     ViewIndex view, const ScribbleLayer& painted,
                                     const DisparityField* disparity, const Progress& progress);

/// An EPI through an object, with its labels.
struct LabelEpi {
  int line = 0;       ///< The image row of a horizontal EPI, the column of a vertical one.
  RgbaImage picture;  ///< `[view][place][4]`: views along the direction, pixels of the line.
  Image<std::int32_t> labels;  ///< `[view][place]`.
};

/// EPIs through a label, one below the other: the boundaries of its labels are straight lines where
/// they agree along the rays.
struct LabelStrip {
  EpiDirection direction = EpiDirection::Horizontal;
  int first_place = 0;  ///< The pixel of the line at place 0 of all EPIs.
  std::vector<LabelEpi> epis;
};

/// Which strip: `count` EPIs at most, evenly over the lines on which `label` is seen in `view`, as
/// far as the label reaches in all views and `margin_px` beyond.
struct LabelStripChoice {
  std::int32_t label = 0;
  ViewIndex view;
  EpiDirection direction = EpiDirection::Horizontal;
  int count = 10;
  int margin_px = 12;
};

/// Makes it; without EPIs if the label is not seen in the view. Precondition: the labeling covers
/// all views of the light field. Throws Cancelled.
[[nodiscard]] LabelStrip label_strip(const LightField& light_field, const Labeling& labeling,
                                     const LabelFinish& finish, const LabelStripChoice& choice,
                                     const Progress& progress);

}  // namespace episcope
