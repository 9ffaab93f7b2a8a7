// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/shell/features.h"

#include "app/gui/scene/document_controller.h"
#include "app/gui/scene/overlay.h"
#include "app/gui/scene/scene_opener.h"
#include "app/gui/scene/viewer_area.h"
#include "app/gui/shell/commands.h"
#include "app/gui/shell/frame.h"
#include "app/gui/shell/jobs.h"
#include "app/gui/shell/workbench.h"
#include "app/session/open_scene.h"
#include "app/session/run_estimator.h"
#include "app/session/scene_summary.h"
#include "app/session/session.h"
#include "engine/core/error.h"
#include "engine/core/jobs.h"
#include "engine/core/shear.h"
#include "widgets/controls/text.h"
#include "widgets/panels/overlay_bar.h"

#include <QObject>

#include <vector>

namespace episcope {

/// Applies the focus plane (shear.h). Reads the light field again, so that repeated shifts
/// interpolate only once; converts results in the background.
class FocusController : public QObject {
  Q_OBJECT

 public:
  explicit FocusController(const Workbench& bench)
      : QObject(&bench.owner), bench_(bench), session_(bench.session), mover_(queued_post(this)) {
    addCommands();
  }

  /// Shifts disparities so that the focus plane has disparity 0.
  void apply() {
    if (canApply()) bake(session_.scene()->convention.focus_px + session_.focus_px());
  }

  /// Restores the zero plane of the files.
  void undo() {
    if (canUndo()) bake(0);
  }
  [[nodiscard]] bool canApply() const { return session_.scene() && session_.focus_px() != 0; }
  [[nodiscard]] bool canUndo() const {
    return session_.scene() && session_.scene()->convention.focus_px != 0;
  }

 private:
  /// State of the view, the document and the results before the shift.
  struct Kept {
    ScenePlace place;
    std::vector<EstimateEntry> results;
    std::size_t shown = 0;     ///< Place in `results`,
    std::size_t compared = 0;  ///< or their number if there is none.
  };

  void addCommands() {
    bench_.commands.add({.menu = Menu::View, .section = section::kFocus},
                        {{.id = "view.focus_apply",
                          .text = tr("Apply focus plane"),
                          .tip = tr("Shifts all disparities, including results and ground truth, "
                                    "so that the focus plane has disparity 0"),
                          .icon = "apply",
                          .keys = {tr("Ctrl+Alt+Return")},
                          .run = [this] { this->apply(); },
                          .enabled = [this] { return canApply(); }},
                         {.id = "view.focus_undo",
                          .text = tr("Undo applied focus plane"),
                          .tip = tr("Restores the disparities of the files"),
                          .run = [this] { undo(); },
                          .enabled = [this] { return canUndo(); }}});
    bench_.viewer_area.overlayBar()->addFocusAction(bench_.commands.find("view.focus_apply"));
  }

  void bake(double focus_px) {
    if (bench_.jobs.count(Lane::Estimate) > 0) {
      bench_.messages.hint(tr(
          "A method is still running on this light field: wait for it to finish, or cancel it."));
      return;
    }
    if (is_moving_) {
      bench_.messages.hint(tr("Results are still being moved to the focus plane: wait a moment."));
      return;
    }
    if (bench_.document.hasUnsavedChanges()) {
      bench_.messages.hint(
          tr("There are unsaved scribbles on this light field: save or undo them first."));
      return;
    }
    const double moved_px = focus_px - session_.scene()->convention.focus_px;
    bench_.opener.reopenAt(focus_px,
                           [this, kept = kept(), moved_px] { bringBack(kept, moved_px); });
  }

  [[nodiscard]] Kept kept() const {
    const std::size_t count = session_.estimates().size();
    Kept kept{session_.place(), {}, count, count};
    for (const EstimateEntry& entry : session_.estimates()) {
      if (session_.shown() == &entry) kept.shown = kept.results.size();
      if (session_.compared() == &entry) kept.compared = kept.results.size();
      kept.results.push_back(entry);
    }
    return kept;
  }

  void bringBack(const Kept& kept, double moved_px) {
    const ScenePlace& place = kept.place;
    session_.set_view(place.view);
    session_.set_cross_hair(place.cross_hair);
    session_.set_tone(place.tone);
    session_.set_label_marks(place.label_marks);
    session_.set_judged(session_.generation(), place.judged);
    Measurements measured = place.measured;
    for (EpiMeasurement& each : measured.list) each.disparity_px -= moved_px;
    session_.set_measurements(measured);
    if (!place.capture.empty()) session_.set_capture(place.capture);
    if (kept.results.empty()) {
      showAsBefore(kept);
    } else {
      moveResults(kept, moved_px);
    }
  }

  /// Neither the user nor opening another light field can cancel this job, since its results would
  /// be lost.
  void moveResults(const Kept& kept, double moved_px) {
    using Moved = std::vector<FinishedEstimate>;
    is_moving_ = true;
    mover_.start<Moved>(
        [light_field = session_.light_field(), results = kept.results, moved_px](const Progress&) {
          const ShearedInto into{light_field->center(), light_field->sample_hash()};
          Moved moved;
          for (const EstimateEntry& each : results) {
            EstimatePtr estimate = each.estimate;
            if (moved_px != 0) {
              estimate = std::make_shared<const Estimate>(
                  sheared(*each.estimate, into, moved_px, Progress()));
            }
            const Interval range = display_range(*estimate);
            moved.push_back({std::move(estimate), range});
          }
          return moved;
        },
        [this, kept, moved_px, scene = session_.generation()](const Outcome<Moved>& outcome) {
          is_moving_ = false;
          if (outcome.value) return addMoved(kept, *outcome.value, scene);
          bench_.messages.fail(schema_text(failure_text(outcome.failure)));
          if (moved_px == 0 || scene != session_.generation()) return;
          const double former_px = session_.scene()->convention.focus_px - moved_px;
          bench_.opener.reopenAt(former_px, [this, kept] { bringBack(kept, 0); });
        });
  }

  void addMoved(const Kept& kept, const std::vector<FinishedEstimate>& moved, std::uint64_t scene) {
    std::vector<int> ids;
    for (const FinishedEstimate& each : moved) {
      ids.push_back(session_.add_estimate(each.estimate, each.display_range, scene));
      const EstimateEntry& former = kept.results[ids.size() - 1];
      session_.rename_estimate(ids.back(), former.name);
      session_.set_note(ids.back(), former.note);
    }
    if (scene != session_.generation()) return;
    if (kept.shown < ids.size()) session_.show_estimate(ids[kept.shown]);
    if (kept.compared < ids.size()) session_.compare_with(ids[kept.compared]);
    showAsBefore(kept);
  }

  void showAsBefore(const Kept& kept) {
    if (kept.place.quantity) bench_.overlay.setQuantity(*kept.place.quantity);
    session_.set_comparison(kept.place.comparison);
    bench_.overlay.setDifference(kept.place.comparison.shows_difference);
  }

  Workbench bench_;
  Session& session_;
  bool is_moving_ = false;
  JobRunner mover_;
};

void add_focus(const Workbench& bench) {
  new FocusController(bench);
}

}  // namespace episcope

#include "focus_controller.moc"
