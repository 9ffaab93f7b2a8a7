// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/gui/annotate/label_scores.h"
#include "app/gui/annotate/labeling_source.h"
#include "app/gui/scene/document_controller.h"
#include "app/gui/scene/overlay.h"
#include "app/gui/shell/jobs.h"
#include "app/gui/shell/workbench.h"
#include "app/session/label_review.h"
#include "app/session/live_labeler.h"
#include "app/session/segmentation.h"
#include "app/session/session.h"

#include <QElapsedTimer>
#include <QObject>
#include <QPointer>

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <utility>

namespace episcope {

class ViewGrid;

/// Segments from scribbles while painting continues: the current view, live or on request, or all
/// views as a job. Shows state and quality of the labels, and provides segmentation maps to the
/// overlay.
class SegmentController : public QObject, public MapProvider {
  Q_OBJECT

 public:
  SegmentController(const Workbench& bench, SegmentPanel* panel);
  ~SegmentController() override;

  /// Live mode: recomputes labels after every change of document, view or settings.
  void setLive(bool is_live);
  [[nodiscard]] bool isLive() const { return is_live_; }
  /// Segments this view once.
  void updateNow();
  /// Segments all views as a job, which continues while other scenes are shown. If the disparity is
  /// still to be estimated, begins when it is there.
  void segmentAllViews();
  /// Ends the current computation for this view; false if there is none.
  bool cancel();

  [[nodiscard]] const LiveLabeler& labeler() const { return live_; }
  /// Whether all views of the shown scene are being segmented.
  [[nodiscard]] bool isSegmentingAll() const;
  [[nodiscard]] bool hasSegmentation() const;
  /// Whether `segmentation` covers all views; quick, as `hasSegmentation`.
  [[nodiscard]] bool hasAllViews() const;
  /// Labels that cover the current view, as files store them, and all others if all were segmented;
  /// none if there are none. Takes a moment if single views have newer labels than the others.
  [[nodiscard]] std::optional<Segmentation> segmentation() const;
  /// Whether those are of the present strokes and settings in all their views.
  [[nodiscard]] bool isSegmentationUpToDate() const;
  /// Shows labels from elsewhere in place of the newest ones, until strokes or settings change, or
  /// until the newest edit, their import, is undone.
  void takeLabels(const LabelingPtr& labeling);
  /// Smooths the boundaries of all labels, as one step of the history.
  void smoothBoundaries(double smoothing_px);
  /// By how many pixels boundaries are smoothed.
  [[nodiscard]] double smoothing() const;

  [[nodiscard]] bool has_map(render::Quantity quantity) const override;
  [[nodiscard]] bool awaits_map(render::Quantity quantity) const override;
  [[nodiscard]] QString title(render::Quantity quantity) const override;
  [[nodiscard]] std::optional<MapSource> map_source(render::Quantity quantity,
                                                    ViewIndex view) const override;

  /// Begins to estimate the disparity of all views in the background, unless one is known.
  void provideDisparity() { source_.provide(); }

 private:
  void connectDocument();
  void connectPanel();
  struct State {
    QString text;
    ChipMood mood;
  };

  [[nodiscard]] bool isComing() const;
  void update(Parts parts);
  void noteInput();
  [[nodiscard]] bool staysImported(LabelingInput now) const;
  void relabel(int from, int to);
  void begin();
  void endWish();
  void finishAll(const LabelingPtr& labeling, const std::shared_ptr<const LabelingInput>& input);
  void startAllViews();
  void goOnWithAllViews();
  [[nodiscard]] bool awaitsDisparity() const;
  void endAllViewsOfClosed();
  void followLabeler();
  void publish();
  void keep(const LabelingPtr& labeling, const LabelingInput& input);
  void restore();
  void adopt(const KeptLabels& kept);
  /// Shows these labels of the scene, or none, in place of all others.
  void putBack(const KeptLabels& kept);
  void stepOverImport(bool is_undo);
  [[nodiscard]] State state() const;
  [[nodiscard]] QString correcting() const;
  void showState();
  void showProgress();
  void score();
  void showLabels();
  [[nodiscard]] bool showsLabels() const;
  [[nodiscard]] LabelerParameters parameters() const;
  [[nodiscard]] LabelFinish finish() const;
  [[nodiscard]] QString missing() const;

  Workbench bench_;
  Session& session_;
  DocumentController& document_;
  Jobs& jobs_;
  SegmentPanel* panel_;
  QPointer<ViewGrid> grid_;
  LabelingSource source_;
  EdgeSource edges_;
  bool is_live_ = false;
  bool wants_to_show_ = false;
  bool is_wanted_ = false;  // an update was asked for that is not there yet
  QElapsedTimer clock_;     // since the labels that are on their way were asked for
  double seconds_ = 0;      // that the newest ones took
  LabelingPtr shown_labeling_;
  std::shared_ptr<const LabelingInput> tried_all_;
  std::map<std::uint64_t, quint64> all_views_;  // the newest job of each scene
  std::set<std::uint64_t> awaiting_;            // scenes whose views are segmented after that
  struct Import {
    KeptLabels before;
    KeptLabels after;
  };
  std::map<std::pair<std::uint64_t, std::uint64_t>, Import>
      imports_;                 // by scene and state after it
  std::uint64_t restored_ = 0;  // scene whose kept labels were brought back
  LabelScores scores_;
  LiveLabeler live_;
};

}  // namespace episcope
