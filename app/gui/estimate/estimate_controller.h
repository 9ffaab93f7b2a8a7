// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/gui/bench/workbench.h"
#include "app/gui/estimate/method_runs.h"
#include "app/session/parts.h"
#include "app/session/run/run_estimator.h"
#include "app/session/session.h"

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

}  // namespace episcope
