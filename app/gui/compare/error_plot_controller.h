// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/gui/shell/jobs.h"
#include "app/gui/shell/workbench.h"
#include "app/session/judge.h"
#include "app/session/open_scene.h"

#include <QObject>
#include <QString>

#include <optional>
#include <string>
#include <vector>

namespace episcope {

class ErrorPlotPanel;
struct EstimateEntry;
class RegionController;
class Session;

/// The tab of errors over true disparity, for the shown result and the one compared with it, in the
/// evaluated region. Computed in the background, only while the tab is visible.
class ErrorPlotController : public QObject {
  Q_OBJECT

 public:
  ErrorPlotController(const Workbench& bench, const RegionController& region);

 private:
  struct Judged {
    std::string name;
    EvaluationPtr evaluation;
    DisparityView truth;  ///< Owned by the scene, which outlives the job.
  };

  void update();
  [[nodiscard]] QString obstacle() const;
  /// None while the evaluation runs.
  [[nodiscard]] std::optional<Judged> judged(const EstimateEntry& entry);
  void start(const std::vector<Judged>& results);

  Workbench bench_;
  Session& session_;
  const RegionController& region_;
  ErrorPlotPanel* panel_;
  LatestJob job_;
};

}  // namespace episcope
