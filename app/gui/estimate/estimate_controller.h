// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/gui/estimate/method_runs.h"
#include "app/gui/shell/workbench.h"
#include "app/session/open_scene.h"
#include "app/session/run_estimator.h"
#include "app/session/session.h"
#include "engine/core/parameter.h"

#include <QObject>

#include <vector>

namespace episcope {

class MethodPanel;
class ResultList;

/// The tab of methods and results: runs methods in the background and lists what they found.
class EstimateController : public QObject {
  Q_OBJECT

 public:
  explicit EstimateController(const Workbench& bench);

  /// Runs what the form says; parameters are copied now.
  void run();
  void run(const EstimateRequest& request);
  /// Cancels all runs on the light field that is shown, as JobCancel does.
  void cancel();
  void removeShown();
  /// Brings back the result that was removed last.
  void restoreRemoved();
  [[nodiscard]] bool canRestore() const;
  /// The line for what the form says.
  void copyCommand();
  void showNeighbour(int step);
  /// Asks what is to be kept in mind about a result.
  void askForNote(const EstimateEntry& entry);

 private:
  struct Removed {
    EstimateEntry entry;
    std::size_t place = 0;    ///< In the list
    std::uint64_t scene = 0;  ///< of this scene.
  };

  void remove(int id);
  void addTab();
  void addCommands();
  void addResultCommands();
  void addNoteCommand();
  void connectResults();
  void update(Parts parts);
  void showChoice();
  void showRunning();
  void listResults();
  void copyCommandOf(const EstimateEntry& entry);
  void copy(const std::string& command);
  void reuse(const EstimateEntry& entry);

  Workbench bench_;
  Session& session_;
  MethodPanel* method_;
  ResultList* results_;
  MethodRuns runs_;
  std::vector<Removed> removed_;  // the latest last
};

/// `range` with one end moved to a disparity. The other end stays; where it is not known or would
/// not lie beyond, it is 0.5 px away. Rounded to 0.01 px, so that what is measured stays inside.
enum class RangeEnd { Lower, Upper };
[[nodiscard]] Interval with_end(Interval range, RangeEnd end, double disparity_px);

/// Commands that make the chosen measurement an end of the range in the form of a method.
void add_measured_range(const Workbench& bench, MethodPanel* panel);

}  // namespace episcope
