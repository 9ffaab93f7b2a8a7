// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/gui/shell/workbench.h"
#include "app/session/open_scene.h"
#include "app/session/sweep.h"
#include "widgets/controls/line_plot.h"

#include <QObject>
#include <QString>
#include <QStringList>

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace episcope {

/// Runs sweeps in the background, one at a time and one light field after the other, loading those
/// that are only on disk. Adds points to SceneSwitcher::sweeps.
class SweepRuns : public QObject {
  Q_OBJECT

 public:
  explicit SweepRuns(const Workbench& bench);

  /// Begins a sweep over these points (`sweep_points`) and returns its id. Precondition: none runs,
  /// and its scenes are open.
  std::uint64_t run(Sweep sweep, const std::vector<ParameterSet>& points);
  [[nodiscard]] bool isRunning() const { return job_ != 0; }
  /// 0 if none runs.
  [[nodiscard]] quint64 job() const { return job_; }
  /// The running sweep, else the last one.
  [[nodiscard]] std::uint64_t sweep() const { return sweep_; }

 signals:
  void ended(quint64 sweep);

 private:
  Workbench bench_;
  quint64 job_ = 0;  // 0 = none runs
  std::uint64_t sweep_ = 0;
};

class MethodPanel;
class SweepPanel;
class SweepRuns;

/// Plot of a sweep, and the sweep point of each plot point.
struct SweepChart {
  /// The mean of all light fields has no place.
  struct Place {
    std::optional<std::size_t> scene;  ///< Index among the sweep's scenes.
    std::size_t point = 0;             ///< Index of the point.
  };
  Plot plot;
  std::vector<std::vector<Place>> places;  ///< By series and point.
};

/// Axis title of a parameter: "smoothing λ [px]".
[[nodiscard]] QString axis_text(const ParameterDescription& description);

/// Names of plottable measures, with units; without ground truth, none that need it.
[[nodiscard]] QStringList measure_names(const Sweep& sweep);
/// Choices of light fields: all together first, then each. Empty if there is only one.
[[nodiscard]] QStringList scene_choices(const Sweep& sweep);
/// Plots measure number `measure` over the first parameter, for choice number `scene`. The choice
/// "all" has one line per light field and their mean; with a second parameter, only lines of the
/// mean.
[[nodiscard]] SweepChart chart_of(const Sweep& sweep, int measure, int choice);
/// Plot place of a sweep point, or of the mean that it counts in; none for values off the grid.
[[nodiscard]] std::optional<PlotPlace> place_in(const SweepChart& chart, SweepPlace point);

/// "EPI_L, inner_scale · 3 light fields"
[[nodiscard]] QString title_of(const Sweep& sweep);
/// "EPI_L, lambda 0.2"
[[nodiscard]] QString name_of(const Sweep& sweep, const SweepPoint& point);
/// Name and scores of a point, or its failure; with the light field if there are several.
[[nodiscard]] QString text_of(const Sweep& sweep, SweepPlace point);

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
  /// The result added for a point.
  struct Shown {
    int id = 0;
    std::string name;
  };
  /// The sweep that Run would start.
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
  /// Throws InvalidInput with a sentence if the plan cannot run.
  [[nodiscard]] Planned planned() const;
  void run();
  void end(quint64 sweep);
  /// The shown sweep; null if there is none.
  [[nodiscard]] const Sweep* current() const;
  void showSweep(std::uint64_t id);
  void showList();
  void showPlots();
  void choose(int plot, const PlotPlace& place);
  void showPoint(SweepPlace place);
  /// Shows the map of a point on the visible light field.
  void showMap(SweepPlace place, const EstimatePtr& map);
  void runAgain(SweepPlace place);
  /// The point shown on the visible light field.
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
