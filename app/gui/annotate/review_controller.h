// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/gui/shell/jobs.h"
#include "app/gui/shell/workbench.h"
#include "app/session/label_review.h"
#include "app/session/session.h"
#include "widgets/panels/label_review_panel.h"

#include <QObject>

#include <memory>
#include <optional>
#include <vector>

class QComboBox;
class QDialog;

namespace episcope {

class CheckPanel;
class EpiStripView;

/// Goes to the places of a view where a stroke would help most, and to the islands and holes of the
/// current label; shows them on the view.
class ReviewController : public QObject {
  Q_OBJECT

 public:
  ReviewController(const Workbench& bench, CheckPanel* panel);

  /// The region in doubt with the next smaller gain (`step` 1) or the next larger one (−1).
  void step(int step);
  /// What is to be checked in this view; null while that is not known.
  [[nodiscard]] const std::shared_ptr<const ViewReview>& review() const { return review_; }

 private:
  /// What a review is made of.
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
  /// Of the review, which must be there.
  [[nodiscard]] std::vector<LabelSummary>::const_iterator summaryOf(int id) const;
  /// `all`: pixels of all labels.
  [[nodiscard]] CheckPanel::Row rowOf(const LabelSummary& label, std::int64_t all) const;
  void goTo(int doubt);
  void goToPiece(int index);
  void mark(const Blob& blob);

  Workbench bench_;
  CheckPanel* panel_;
  std::optional<Subject> subject_;  // of the review, or of the one that is being made
  std::shared_ptr<const ViewReview> review_;
  int doubt_ = -1;   // that is marked
  int awaited_ = 0;  // a step that was asked for before the review was there
  LatestJob job_;
};

/// A window with the current label over the views: EPIs through it with the boundaries of labels.
class StripController : public QObject {
  Q_OBJECT

 public:
  /// The panel gets a button.
  StripController(const Workbench& bench, CheckPanel* panel);

 private:
  /// What a strip is made of.
  struct Subject {
    LabelingPtr labeling;
    LabelFinish finish;
    int label = 0;
    ViewIndex view;
    EpiDirection direction = EpiDirection::Horizontal;
    friend bool operator==(const Subject&, const Subject&) = default;
  };

  void addCommands(CheckPanel* panel);
  void open();
  void update();
  void begin(const Subject& subject);
  void show(const LabelStrip& strip, const Subject& subject);
  void hint(const QString& sentence);
  void goTo(int index, int view, int place);
  [[nodiscard]] EpiDirection direction() const;

  Workbench bench_;
  QDialog* dialog_;
  QComboBox* direction_;
  EpiStripView* strip_view_;
  std::optional<Subject> subject_;
  LabelStrip strip_;
  LatestJob job_;
};

/// Section of the menu Segmentation, after those of the segmentation itself.
inline constexpr int kCheckSection = 2;

}  // namespace episcope
