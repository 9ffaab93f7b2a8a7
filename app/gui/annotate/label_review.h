// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "annotation/brush.h"
#include "app/gui/shell/jobs.h"
#include "app/gui/shell/workbench.h"
#include "app/session/label_review.h"
#include "app/session/session.h"
#include "widgets/panels/label_review_panel.h"

#include <QObject>

#include <memory>
#include <optional>
#include <vector>

namespace episcope {

/// Goes to the places of a view where a stroke would help most, and to the islands and holes of the
/// current label, and marks them on the view.
class LabelReviewController : public QObject {
  Q_OBJECT

 public:
  LabelReviewController(const Workbench& bench, LabelReviewPanel* panel);

  /// Goes to the uncertain region with the next smaller gain (`step` 1) or the next larger gain
  /// (−1).
  void step(int step);
  /// Review of this view; null while unknown.
  [[nodiscard]] const std::shared_ptr<const ViewReview>& review() const { return review_; }

 private:
  /// Input of a review.
  struct Subject {
    std::uint64_t scene = 0;
    ViewIndex view;
    LabelingPtr labeling;
    LabelFinish finish;
    std::uint64_t document = 0;  ///< AnnotationDocument::state.
    std::shared_ptr<const DisparityField> disparity;
    friend bool operator==(const Subject&, const Subject&) = default;
  };

  void addCommands();
  [[nodiscard]] std::optional<Subject> subject() const;
  void look();
  void begin(const Subject& subject);
  void take(ViewReview review);
  void show();
  void showPieces();
  [[nodiscard]] LabelInfo infoOf(int id) const;
  /// Summary of a label. Precondition: there is a review.
  [[nodiscard]] std::vector<LabelSummary>::const_iterator summaryOf(int id) const;
  /// `all`: number of pixels of all labels.
  [[nodiscard]] LabelReviewPanel::Row rowOf(const LabelSummary& label, std::int64_t all) const;
  void goTo(int doubt);
  void goToPiece(int index);
  /// Paints a region of the view.
  void give(const PixelRegion& region, int id);
  void mark(const Blob& blob);

  Workbench bench_;
  LabelReviewPanel* panel_;
  std::optional<Subject> subject_;  // of the review, or of the one that is being made
  std::shared_ptr<const ViewReview> review_;
  int doubt_ = -1;   // that is marked
  int awaited_ = 0;  // a step that was asked for before the review was there
  LatestJob job_;
};

/// Section of the menu Segmentation, below the commands of the segmentation itself.
inline constexpr int kCheckSection = 2;

}  // namespace episcope
