// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/shell/features.h"

#include "app/gui/estimate/live_controller.h"
#include "app/gui/estimate/sweep_chart.h"
#include "app/gui/scene/overlay.h"
#include "app/gui/scene/scene_opener.h"
#include "app/gui/scene/scene_switcher.h"
#include "app/gui/scene/viewer_area.h"
#include "app/gui/shell/commands.h"
#include "app/gui/shell/dialogs.h"
#include "app/gui/shell/frame.h"
#include "app/gui/shell/jobs.h"
#include "app/gui/shell/workbench.h"
#include "app/session/command_line.h"
#include "app/session/open_scene.h"
#include "app/session/session.h"
#include "app/session/sweep.h"
#include "engine/core/error.h"
#include "engine/core/text.h"
#include "engine/disparity/registry.h"
#include "widgets/controls/parameter_form.h"
#include "widgets/controls/text.h"
#include "widgets/panels/method_panel.h"
#include "widgets/panels/sweep_panel.h"

#include <QObject>
#include <QPointer>

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace episcope {

namespace {

/// What a worker does.
struct Work {
  struct Of {
    std::uint64_t scene = 0;
    std::string name;
    SceneSource source;
  };
  std::vector<Of> scenes;
  EstimateRequest base;
  std::vector<ParameterSet> points;
  std::function<void(std::uint64_t scene, const SweepPoint&)> tell;
};

// Every point of an unreadable light field tells why.
std::shared_ptr<const Scene> read(const Work& work, const Work::Of& of, const Progress& progress) {
  try {
    return of.source(progress);
  } catch (const Error& error) {
    for (const ParameterSet& each : work.points) {
      SweepPoint failed;
      failed.point = each;
      failed.problem = error.what();
      work.tell(of.scene, failed);
    }
    return nullptr;
  }
}

void run_scene(const Work& work, const Work::Of& of, const Progress& progress) {
  const auto scene = read(work, of, progress.part(0, 0.02));
  if (!scene) return;
  const Progress running = progress.part(0.02, 1);
  EstimatePtr reference;
  const auto count = static_cast<double>(work.points.size());
  for (std::size_t i = 0; i < work.points.size(); ++i) {
    const auto begin = static_cast<double>(i);
    std::string step = std::to_string(i + 1) + " / " + std::to_string(work.points.size());
    if (work.scenes.size() > 1) step = of.name + ", " + step;
    const SweepPoint point =
        run_sweep_point(*scene, work.base, work.points[i], reference.get(),
                        running.part(begin / count, (begin + 1) / count).titled(step));
    if (i == 0) reference = point.estimate;
    work.tell(of.scene, point);
  }
}

bool run_all(const Work& work, const Progress& progress) {
  const auto count = static_cast<double>(work.scenes.size());
  for (std::size_t i = 0; i < work.scenes.size(); ++i) {
    const auto begin = static_cast<double>(i);
    run_scene(work, work.scenes[i], progress.part(begin / count, (begin + 1) / count));
  }
  return true;
}

}  // namespace

/// Runs sweeps in the background, one at a time and one light field after the other, loading those
/// that are only on disk. Adds points to SceneSwitcher::sweeps.
class SweepRuns : public QObject {
  Q_OBJECT

 public:
  explicit SweepRuns(const Workbench& bench) : QObject(&bench.owner), bench_(bench) {
    bench.scenes.sweeps().on_changed([this] {
      if (isRunning() && !bench_.scenes.sweeps().find(sweep_)) bench_.jobs.cancel(job_);
    });
  }

  /// Begins a sweep over these points (`sweep_points`) and returns its id. Precondition: none runs,
  /// and its scenes are open.
  quint64 run(Sweep sweep, const std::vector<ParameterSet>& points) {
    Work work;
    work.base = sweep.base;
    work.points = points;
    for (const SweepScene& each : sweep.scenes) {
      const OpenScene& open = *bench_.session.find_scene(each.scene);
      work.scenes.push_back(
          {each.scene, each.name, scene_source(open, bench_.opener.cacheFolder(), true)});
    }
    const std::uint64_t only = work.scenes.size() == 1 ? work.scenes.front().scene : 0;
    QString title =
        tr("Sweep of %1").arg(QString::fromStdString(find_estimator(sweep.base.method).info.name));
    if (only != 0) title = job_title(title, *bench_.session.find_scene(only));
    const std::uint64_t id = bench_.scenes.sweeps().add(std::move(sweep));
    work.tell = [post = queued_post(&bench_.jobs), self = QPointer(this), id](
                    std::uint64_t scene, const SweepPoint& point) {
      post([self, id, scene, point] {
        if (self) self->bench_.scenes.sweeps().add_point(id, scene, point);
      });
    };
    sweep_ = id;
    job_ = bench_.jobs.start<bool>(
        Lane::Estimate, title,
        [work = std::move(work)](const Progress& progress) { return run_all(work, progress); },
        [](bool) {},
        [this, id] {
          job_ = 0;
          emit ended(id);
        });
    bench_.jobs.setScene(job_, only);
    return id;
  }

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

namespace {

std::vector<ParameterDescription> descriptions_of(const RunRequest& request) {
  return described_under(find_estimator(request.method).parameters, request.values);
}

// Proposes values around the form's value.
ParameterDescription at_present(ParameterDescription description, const ParameterSet& values) {
  if (const auto* present = find_value(values, description.key)) {
    description.default_value = *present;
  }
  return description;
}

}  // namespace

/// The tab of sweeps: runs the method of the form with a grid of values of one or two of its
/// parameters on the light field that is shown, or on all that are open, in the background, and
/// plots what comes of it. Sweeps stay as long as their light fields, and with the project. The
/// maps of the points are not in the list of results: the one of the point that was chosen last
/// stands there, in the place of the one before, until the user keeps it.
class SweepController : public QObject {
  Q_OBJECT

 public:
  SweepController(const Workbench& bench, MethodPanel& method)
      : QObject(&bench.owner), bench_(bench), method_(method), runs_(new SweepRuns(bench)) {
    addTab();
    connectPanel();
    bench.session.on_changed([this](Parts parts) { update(parts); });
    bench.scenes.sweeps().on_changed([this] { followSweeps(); });
    showMethod();
    showList();
    showPlots();
  }

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

  void addTab() {
    panel_ = new SweepPanel(&bench_.frame);
    bench_.frame.addTab({.id = "sweep",
                         .title = tr("Sweep"),
                         .task = "estimate",
                         .command_text = tr("Sweep tab"),
                         .command_tip = tr("Tries values of one or two parameters of the method"),
                         .widget = panel_,
                         .key = QKeySequence()});  // “Sweep parameters…” has one
    bench_.commands.add({.id = "sweep.save",
                         .menu = Menu::Export,
                         .text = tr("Sweep (CSV)…"),
                         .tip = tr("Writes the points of the sweep that is shown in the Sweep tab"),
                         .run = [this] { save(); },
                         .section = section::kResults,
                         .enabled = [this] { return current() != nullptr; }});
  }

  void connectPanel() {
    connect(&method_, &MethodPanel::methodChanged, this, &SweepController::showMethod);
    connect(method_.form(), &ParameterForm::valuesChanged, this, &SweepController::showPlan);
    connect(&bench_.frame, &Frame::tabShown, this, &SweepController::showMethod);
    connect(panel_, &SweepPanel::planEdited, this, &SweepController::showPlan);
    connect(&bench_.viewer_area, &ViewerArea::previewChanged, this, &SweepController::showPlan);
    connect(panel_, &SweepPanel::runRequested, this, &SweepController::run);
    connect(panel_, &SweepPanel::cancelRequested, this,
            [this] { bench_.job_cancel.cancel({runs_->job()}); });
    connect(runs_, &SweepRuns::ended, this, &SweepController::end);
    connect(panel_, &SweepPanel::sweepChosen, this, &SweepController::showSweep);
    connect(panel_, &SweepPanel::removeRequested, this,
            [this] { bench_.scenes.sweeps().remove(current_); });
    connect(panel_, &SweepPanel::sceneChosen, this, &SweepController::showPlots);
    connect(panel_, &SweepPanel::measureChosen, this, &SweepController::showPlots);
    connect(panel_, &SweepPanel::pointChosen, this, &SweepController::choose);
    connect(panel_, &SweepPanel::keepRequested, this, &SweepController::keep);
    connect(panel_, &SweepPanel::useRequested, this, &SweepController::use);
    connect(panel_, &SweepPanel::exportRequested, this, &SweepController::save);
  }

  void update(Parts parts) {
    if (parts.has_any(Part::Scene | Part::Scenes)) {
      panel_->setSceneCount(static_cast<int>(bench_.session.scenes().size()));
      showPlan();
    }
    if (parts.has(Part::Scene) && !current()) showPlots();
  }

  void followSweeps() {
    const bool is_gone = current_ != 0 && !current();
    if (is_gone || current_ == 0) {
      const auto& all = bench_.scenes.sweeps().all();
      showSweep(all.empty() ? 0 : all.back().id);
    } else {
      if (chosen_ && !bench_.scenes.sweeps().find(current_, *chosen_)) chosen_.reset();
      showList();
      showPlots();
    }
  }

  void showMethod() {
    const RunRequest request = method_.request();
    if (request.method.empty()) return;
    std::vector<SweepPanel::Parameter> parameters;
    for (const ParameterDescription& each : descriptions_of(request)) {
      if (!can_sweep(each)) continue;
      parameters.push_back(
          {QString::fromStdString(each.key), axis_text(each),
           QString::fromStdString(proposed_sweep_values(at_present(each, request.values))),
           !each.searched.empty()});
    }
    panel_->setMethod(QString::fromStdString(request.method),
                      tr("%1, other values as in Method")
                          .arg(QString::fromStdString(find_estimator(request.method).info.name)),
                      parameters);
    showPlan();
  }

  void showPlan() {
    const QString reason = why_nothing_runs(bench_.session, bench_.viewer_area);
    if (!reason.isEmpty()) return panel_->setPlan(reason, false);
    try {
      const Planned plan = planned();
      const auto count = plan.points.size();
      const auto scenes = plan.sweep.scenes.size();
      panel_->setPlan(scenes > 1
                          ? tr("%1 runs on each of %2 center views, the present values first")
                                .arg(count)
                                .arg(scenes)
                          : tr("%1 runs on the center view, the present values first").arg(count),
                      !runs_->isRunning());
    } catch (const InvalidInput& error) {
      QString sentence = with_minus(QString::fromUtf8(error.what()));
      if (!sentence.isEmpty()) sentence[0] = sentence[0].toUpper();
      panel_->setPlan(sentence, false);
    }
  }

  /// Throws InvalidInput with a sentence if the plan cannot run.
  [[nodiscard]] Planned planned() const {
    const RunRequest request = method_.request();
    const std::vector<ParameterDescription> descriptions = descriptions_of(request);
    Planned planned;
    Sweep& sweep = planned.sweep;
    sweep.base = request_of(request);
    sweep.base.options.views = ViewSelection::Center;
    for (const SweepPanel::Choice& choice : panel_->choices()) {
      const auto known =
          std::ranges::find(descriptions, choice.key.toStdString(), &ParameterDescription::key);
      if (known == descriptions.end()) continue;
      if (!sweep.swept.empty() && sweep.swept.front().key == known->key) {
        throw InvalidInput(tr("Choose two different parameters.").toStdString());
      }
      sweep.swept.push_back({known->key, parse_sweep_values(*known, choice.values.toStdString())});
    }
    if (sweep.swept.empty()) {
      throw InvalidInput(tr("This method has no number that could be varied.").toStdString());
    }
    planned.points = sweep_points(descriptions, request.values, sweep.swept);
    const Session& session = bench_.session;
    for (const OpenScene* each : session.scenes()) {
      if (panel_->isOnAllScenes() || each->id == session.generation()) {
        sweep.scenes.push_back({each->id, each->name});
      }
    }
    return planned;
  }

  void run() {
    if (runs_->isRunning() || !bench_.session.scene()) return;
    dropShown();
    Planned plan = planned();
    const std::uint64_t id = runs_->run(std::move(plan.sweep), plan.points);
    panel_->setRunning(true);
    showPlan();
    showSweep(id);
  }

  void end(quint64 id) {
    panel_->setRunning(false);
    showPlan();
    showPlots();
    const Sweep* sweep = bench_.scenes.sweeps().find(id);
    if (!sweep) return;
    for (const SweepScene& scene : sweep->scenes) {
      const auto failed = std::ranges::find_if(
          scene.points, [](const SweepPoint& point) { return !point.problem.empty(); });
      if (failed == scene.points.end()) continue;
      bench_.messages.warn(
          tr("%1: %2").arg(name_of(*sweep, *failed), QString::fromStdString(failed->problem)));
      return;
    }
  }

  /// The shown sweep; null if there is none.
  [[nodiscard]] const Sweep* current() const { return bench_.scenes.sweeps().find(current_); }

  void showSweep(std::uint64_t id) {
    if (id != current_) chosen_.reset();
    current_ = id;
    showList();
    showPlots();
  }

  void showList() {
    QStringList titles;
    int row = -1;
    std::vector<quint64> ids;
    for (const Sweep& each : bench_.scenes.sweeps().all()) {
      if (each.id == current_) row = static_cast<int>(titles.size());
      titles << title_of(each);
      ids.push_back(each.id);
    }
    panel_->setSweeps(titles, ids, row);
    panel_->setScenes(current() ? scene_choices(*current()) : QStringList());
  }

  void showPlots() {
    const Sweep nothing;
    const Sweep& sweep = current() ? *current() : nothing;
    const auto& scene = bench_.session.scene();
    panel_->setMeasures(
        measure_names(sweep, !scene || scene->truth->has_disparity() || scene->truth->has_layers()),
        0, 1);
    const bool is_running = runs_->isRunning() && runs_->sweep() == current_;
    const bool has_points = std::ranges::any_of(
        sweep.scenes, [](const SweepScene& each) { return !each.points.empty(); });
    const QString instead = is_running                ? tr("The first point is being computed.")
                            : !bench_.session.scene() ? open_a_light_field()
                            : !has_points ? tr("Press Run: a point is plotted here for each value.")
                                          : tr("The points have no such number.");
    const auto measures = panel_->measures();
    for (std::size_t i = 0; i < charts_.size(); ++i) {
      charts_[i] = chart_of(sweep, measures[i], panel_->scene());
    }
    panel_->setPlots(charts_[0].plot, charts_[1].plot, instead);
    panel_->setExportable(has_points);
    describe();
  }

  // A point of the mean shows the map of the visible light field.
  void choose(int plot, const PlotPlace& chosen) {
    const auto& places = charts_.at(static_cast<std::size_t>(plot)).places;
    const SweepChart::Place place = places.at(chosen.series).at(chosen.point);
    const auto& scenes = current()->scenes;
    const auto seen = std::ranges::find(scenes, bench_.session.generation(), &SweepScene::scene);
    const auto usual = seen == scenes.end() ? 0 : static_cast<std::size_t>(seen - scenes.begin());
    showPoint({place.scene.value_or(usual), place.point});
  }

  void showPoint(SweepPlace place) {
    const SweepPoint* point = bench_.scenes.sweeps().find(current_, place);
    if (!point) return;
    chosen_ = place;
    const std::uint64_t scene = current()->scenes[place.scene].scene;
    if (bench_.session.generation() != scene) {
      bench_.scenes.show(scene, [this, place, scene, sweep = current_] {
        if (sweep == current_ && bench_.session.generation() == scene) showPoint(place);
      });
    } else if (point->estimate) {
      showMap(place, point->estimate);
    } else if (point->problem.empty()) {
      runAgain(place);
    }
    describe();
  }

  /// Shows the map of a point on the visible light field.
  void showMap(SweepPlace place, const EstimatePtr& map) {
    dropShown();
    Session& session = bench_.session;
    const SweepPoint& point = *bench_.scenes.sweeps().find(current_, place);
    const int id = session.add_estimate(map, point.display_range, session.generation());
    session.mark_saved(id);     // the sweep holds it
    session.show_estimate(id);  // it was asked for
    session.rename_estimate(id, name_of(*current(), point).toStdString());
    shown_[session.generation()] = {id, session.find_estimate(id)->name};
    bench_.overlay.showResults();
  }

  void runAgain(SweepPlace place) {
    const Sweep& sweep = *current();
    const SweepPoint& point = *bench_.scenes.sweeps().find(current_, place);
    const EstimateRequest request{sweep.base.method, values_at(sweep.base.parameters, point.point),
                                  sweep.base.options};
    const quint64 job = bench_.jobs.start<FinishedEstimate>(
        Lane::Estimate, job_title(name_of(sweep, point), bench_.session),
        [scene = bench_.session.scene(), request](const Progress& progress) {
          return run_estimator(*scene, find_estimator(request.method), request.parameters,
                               request.options, progress);
        },
        [this, place, id = current_,
         scene = sweep.scenes[place.scene].scene](const FinishedEstimate& finished) {
          SweepList& sweeps = bench_.scenes.sweeps();
          if (!sweeps.find(id, place) || sweeps.find(id)->scenes[place.scene].scene != scene)
            return;
          sweeps.set_map(id, place, finished.estimate);
          if (id != current_ || chosen_ != place || bench_.session.generation() != scene) return;
          showMap(place, finished.estimate);
          describe();
        });
    bench_.jobs.setScene(job, bench_.session.generation());
  }

  /// The point shown on the visible light field.
  [[nodiscard]] Shown shownHere() const {
    const auto found = shown_.find(bench_.session.generation());
    return found == shown_.end() ? Shown() : found->second;
  }

  // Keeps results that the user named or annotated.
  void dropShown() {
    Session& session = bench_.session;
    const Shown former = std::exchange(shown_[session.generation()], {});
    const EstimateEntry* entry = session.find_estimate(former.id);
    if (!entry || entry->name != former.name || !entry->note.empty()) return;
    session.remove_estimate(former.id);
  }

  void describe() {
    const Sweep* sweep = current();
    if (!sweep || !chosen_ || !bench_.scenes.sweeps().find(current_, *chosen_)) {
      const bool has_points = sweep && !charts_[0].places.empty() && panel_->isExportable();
      const bool is_judged = sweep && std::ranges::any_of(sweep->scenes, has_truth);
      const QString hint = !has_points ? QString()
                           : is_judged ? tr("Click a point to see its map.")
                                       : tr("No ground truth: click a point to see its map.");
      return panel_->setChosen({}, hint, false, false);
    }
    panel_->setChosen({place_in(charts_[0], *chosen_), place_in(charts_[1], *chosen_)},
                      text_of(*sweep, *chosen_), shownHere().id != 0, true);
  }

  void keep() {
    const Shown kept = std::exchange(shown_[bench_.session.generation()], {});
    bench_.session.mark_saved(kept.id, false);
    bench_.messages.hint(
        tr("%1 stays in the list of results.").arg(QString::fromStdString(kept.name)));
    describe();
  }

  void use() {
    const Sweep& sweep = *current();
    const SweepPoint& point = *bench_.scenes.sweeps().find(current_, *chosen_);
    method_.setRequest({sweep.base.method, values_at(sweep.base.parameters, point.point),
                        method_.request().all_views});
    showMethod();
    bench_.messages.hint(tr("The form of the Estimate tab has the values of this point."));
  }

  void save() {
    const Sweep& sweep = *current();
    const std::string parameters =
        joined(changed_parameters(sweep.base.method, sweep.base.parameters), " ",
               [](const auto& each) { return each.first + "=" + to_text(each.second); });
    const QString text = QString::fromStdString(table_to_csv(
        sweep_table(sweep.scenes, {{"method", sweep.base.method}, {"parameters", parameters}})));
    const std::string stem = sweep.scenes.size() == 1 ? sweep.scenes.front().name + "_" : "";
    ask_where_to_save_text(
        bench_,
        {.name = "save_sweep",
         .title = tr("Save the sweep"),
         .filter = tr("CSV (*.csv)"),
         .proposal = QString::fromStdString(stem + sweep.base.method + "_sweep.csv")},
        text, [this, written = sweep] { bench_.scenes.sweeps().mark_saved(written); });
  }

  Workbench bench_;
  MethodPanel& method_;
  SweepRuns* runs_;
  SweepPanel* panel_ = nullptr;
  std::uint64_t current_ = 0;
  std::array<SweepChart, 2> charts_;  // upper and lower
  std::optional<SweepPlace> chosen_;
  std::map<std::uint64_t, Shown> shown_;  // by scene
};

void add_sweeps(const Workbench& bench, MethodPanel& panel) {
  new SweepController(bench, panel);
}

}  // namespace episcope

#include "sweep_controller.moc"
