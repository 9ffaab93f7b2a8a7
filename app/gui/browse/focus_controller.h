// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/gui/shell/workbench.h"
#include "app/session/open_scene.h"
#include "app/session/run_estimator.h"
#include "engine/core/jobs.h"

#include <QObject>

#include <vector>

namespace episcope {

/// Applies the focus plane (shear.h). The light field is read again, so that it is interpolated
/// only once however often this is done; results are converted in the background.
class FocusController : public QObject {
  Q_OBJECT

 public:
  explicit FocusController(const Workbench& bench);

  /// What is in focus gets disparity 0.
  void apply();
  /// Back to the plane of zero disparity of the files.
  void undo();
  [[nodiscard]] bool canApply() const;
  [[nodiscard]] bool canUndo() const;

 private:
  /// What is looked at and was done there, and the results.
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
  /// Not among the jobs that the user can cancel, nor those that opening ends: the results would be
  /// lost with it.
  void moveResults(const Kept& kept, double moved_px);
  void addMoved(const Kept& kept, const std::vector<FinishedEstimate>& moved, std::uint64_t scene);
  void showAsBefore(const Kept& kept);

  Workbench bench_;
  Session& session_;
  bool is_moving_ = false;
  JobRunner mover_;
};

}  // namespace episcope
