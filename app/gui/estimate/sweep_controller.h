// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/gui/bench/workbench.h"
#include "app/gui/estimate/sweep_plot.h"
#include "app/session/parts.h"

#include <QObject>

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>

namespace episcope {

class MethodPanel;
class SweepPanel;
class SweepRuns;
struct PlotPlace;

/// The tab of sweeps: runs the method of the form with a grid of values of one or two of its
/// parameters on the light field that is shown, or on all that are open, in the background, and
/// plots what comes of it. Sweeps stay as long as their light fields, and with the project. The
/// maps of the points are not in the list of results: the one of the point that was chosen last
/// stands there, in the place of the one before, until the user keeps it.
class SweepController : public QObject {
  Q_OBJECT

 public:
  SweepController(const Workbench& bench, MethodPanel& method);

 private:
  /// The result that shows a point.
  struct Shown {
    int id = 0;
    std::string name;
  };
  /// What Run would do.
  struct Planned {
    Sweep sweep;
    std::vector<ParameterSet> points;
  };

  void addTab();
  void connectPanel();
  void update(Parts parts);
  void followSweeps();
  void showMethod();
  void showPlan();
  /// Throws InvalidInput, a sentence, for what cannot be run.
  [[nodiscard]] Planned planned() const;
  void run();
  void end(quint64 sweep);
  /// The sweep that is shown; null if there is none.
  [[nodiscard]] const Sweep* current() const;
  void showSweep(std::uint64_t id);
  void showList();
  void showPlots();
  void choose(int plot, const PlotPlace& place);
  void showPoint(SweepPlace place);
  /// Of a point of the light field that is in sight.
  void showMap(SweepPlace place, const EstimatePtr& map);
  void runAgain(SweepPlace place);
  /// On the light field that is in sight.
  [[nodiscard]] Shown shownHere() const;
  void dropShown();
  void describe();
  void keep();
  void use();
  void save();

  Workbench bench_;
  MethodPanel& method_;
  SweepRuns* runs_;
  SweepPanel* panel_ = nullptr;
  std::uint64_t current_ = 0;
  std::array<SweepChart, 2> charts_;  // upper and lower
  std::optional<SweepPlace> chosen_;
  std::map<std::uint64_t, Shown> shown_;  // by scene
};

}  // namespace episcope
