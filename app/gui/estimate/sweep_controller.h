// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/gui/bench/workbench.h"
#include "app/gui/estimate/sweep_plot.h"
#include "app/session/parts.h"

#include <QObject>

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

namespace episcope {

class MethodPanel;
class SweepPanel;
struct PlotPlace;

/// The tab of sweeps: runs the method of the form with a grid of values of one or two of its
/// parameters on the light field that is shown, in the background, and plots what comes of it. The
/// maps of the points are kept here and not in the list of results: the one of the point that was
/// chosen last stands there, in the place of the one before, until the user keeps it.
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

  void addTab();
  void connectPanel();
  void update(Parts parts);
  void showMethod();
  void showPlan();
  /// Throws InvalidInput, a sentence, for what cannot be run.
  [[nodiscard]] Sweep planned() const;
  void run();
  [[nodiscard]] std::function<bool(const Progress&)> work(const Sweep& sweep);
  void take(std::uint64_t number, SweepPoint point);
  void end(std::uint64_t number);
  void showPlots();
  void choose(const PlotPlace& place);
  void showPoint(std::size_t point);
  void runAgain(std::size_t point);
  void dropShown();
  void describe();
  void keep();
  void use();
  void save();

  Workbench bench_;
  MethodPanel& method_;
  SweepPanel* panel_ = nullptr;
  Sweep sweep_;
  quint64 job_ = 0;  // of the sweep; 0 = none runs
  std::uint64_t last_number_ = 0;
  std::optional<std::size_t> chosen_;  // among the points
  Shown shown_;
};

}  // namespace episcope
