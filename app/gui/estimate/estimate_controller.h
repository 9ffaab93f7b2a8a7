// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/gui/estimate/live_controller.h"
#include "app/gui/shell/workbench.h"
#include "app/session/open_scene.h"
#include "app/session/run_estimator.h"
#include "app/session/session.h"

#include <QObject>

#include <vector>

namespace episcope {

class MethodPanel;
class ResultList;
struct ResultRow;

/// The tab of methods and results: runs methods in the background and lists results.
class EstimateController : public QObject {
  Q_OBJECT

 public:
  explicit EstimateController(const Workbench& bench);

  /// Runs the method of the form with its current parameters.
  void run();
  void run(const EstimateRequest& request);
  /// Cancels all runs on the shown light field, as JobCancel does.
  void cancel();
  /// Restores the result removed last.
  void restoreRemoved();
  [[nodiscard]] bool canRestore() const;
  /// Copies the command line for the form.
  void copyCommand();
  void showNeighbour(int step);
  /// Asks for a note on a result.
  void askForNote(const EstimateEntry& entry);

 private:
  struct Removed {
    EstimateEntry entry;
    std::size_t place = 0;    ///< In the list
    std::uint64_t scene = 0;  ///< of this scene.
  };

  void remove(int id);
  void runFirst(const QString& input);
  void addTargets();
  void addTab();
  void addCommands();
  void addResultCommands();
  void connectResults();
  void update(Parts parts);
  void showChoice();
  void showRunning();
  void listResults();
  [[nodiscard]] ResultRow rowOf(const EstimateEntry& entry) const;
  [[nodiscard]] quint64 rowId(const EstimateEntry& entry) const;
  void copy(const std::string& command);
  void reuse(const EstimateEntry& entry);

  Workbench bench_;
  Session& session_;
  MethodPanel* method_;
  ResultList* results_;
  MethodRuns runs_;
  std::vector<Removed> removed_;  // the latest last
  bool is_settled_ = true;        // no earlier work is offered
};

/// `range` with one end moved to a disparity. The other end stays, or is set 0.5 px away if it is
/// unknown or on the wrong side. Rounds outwards to 0.01 px.
enum class RangeEnd { Lower, Upper };
[[nodiscard]] Interval with_end(Interval range, RangeEnd end, double disparity_px);

/// Adds commands that make the chosen measurement an end of a method's range.
void add_measured_range(const Workbench& bench, MethodPanel* panel);

}  // namespace episcope
