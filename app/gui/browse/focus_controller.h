// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/gui/shell/workbench.h"
#include "app/session/open_scene.h"
#include "app/session/run_estimator.h"
#include "app/session/session.h"
#include "engine/core/jobs.h"

#include <QObject>

#include <vector>

namespace episcope {

/// Applies the focus plane (shear.h). Reads the light field again, so that repeated shifts
/// interpolate only once; converts results in the background.
class FocusController : public QObject {
  Q_OBJECT

 public:
  explicit FocusController(const Workbench& bench);

  /// Shifts disparities so that the focus plane has disparity 0.
  void apply();
  /// Restores the zero plane of the files.
  void undo() {
    if (canUndo()) bake(0);
  }
  [[nodiscard]] bool canApply() const { return session_.scene() && session_.focus_px() != 0; }
  [[nodiscard]] bool canUndo() const;

 private:
  /// State of the view, the document and the results before the shift.
  struct Kept {
    ScenePlace place;
    std::vector<EstimateEntry> results;
    std::size_t shown = 0;     ///< Place in `results`,
    std::size_t compared = 0;  ///< or their number if there is none.
  };

  void addCommands();
  void bake(double focus_px);
  [[nodiscard]] Kept kept() const;
  void bringBack(const Kept& kept, double moved_px);
  /// Neither the user nor opening another light field can cancel this job, since its results would
  /// be lost.
  void moveResults(const Kept& kept, double moved_px);
  void addMoved(const Kept& kept, const std::vector<FinishedEstimate>& moved, std::uint64_t scene);
  void showAsBefore(const Kept& kept);

  Workbench bench_;
  Session& session_;
  bool is_moving_ = false;
  JobRunner mover_;
};

}  // namespace episcope
