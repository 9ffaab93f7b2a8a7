// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/estimate/sweep_controller.h"

#include "app/gui/estimate/live_controller.h"
#include "app/gui/scene/overlay.h"
#include "app/gui/scene/scene_opener.h"
#include "app/gui/scene/scene_switcher.h"
#include "app/gui/scene/viewer_area.h"
#include "app/gui/shell/commands.h"
#include "app/gui/shell/dialogs.h"
#include "app/gui/shell/frame.h"
#include "app/gui/shell/jobs.h"
#include "app/session/command_line.h"
#include "app/session/session.h"
#include "engine/core/error.h"
#include "engine/core/text.h"
#include "engine/disparity/registry.h"
#include "widgets/controls/parameter_form.h"
#include "widgets/controls/text.h"
#include "widgets/panels/method_panel.h"
#include "widgets/panels/sweep_panel.h"

#include <QCoreApplication>
#include <QPointer>

#include <algorithm>
#include <functional>
#include <span>
#include <utility>

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

SweepRuns::SweepRuns(const Workbench& bench) : QObject(&bench.owner), bench_(bench) {
  bench.scenes.sweeps().on_changed([this] {
    if (isRunning() && !bench_.scenes.sweeps().find(sweep_)) bench_.jobs.cancel(job_);
  });
}

std::uint64_t SweepRuns::run(Sweep sweep, const std::vector<ParameterSet>& points) {
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

SweepController::SweepController(const Workbench& bench, MethodPanel& method)
    : QObject(&bench.owner), bench_(bench), method_(method), runs_(new SweepRuns(bench)) {
  addTab();
  connectPanel();
  bench.session.on_changed([this](Parts parts) { update(parts); });
  bench.scenes.sweeps().on_changed([this] { followSweeps(); });
  showMethod();
  showList();
  showPlots();
}

void SweepController::addTab() {
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

void SweepController::connectPanel() {
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

void SweepController::update(Parts parts) {
  if (parts.has_any(Part::Scene | Part::Scenes)) {
    panel_->setSceneCount(static_cast<int>(bench_.session.scenes().size()));
    showPlan();
  }
  if (parts.has(Part::Scene) && !current()) showPlots();
}

void SweepController::followSweeps() {
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

const Sweep* SweepController::current() const {
  return bench_.scenes.sweeps().find(current_);
}

void SweepController::showSweep(std::uint64_t id) {
  if (id != current_) chosen_.reset();
  current_ = id;
  showList();
  showPlots();
}

void SweepController::showList() {
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

void SweepController::showMethod() {
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

SweepController::Planned SweepController::planned() const {
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

void SweepController::showPlan() {
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

void SweepController::run() {
  if (runs_->isRunning() || !bench_.session.scene()) return;
  dropShown();
  Planned plan = planned();
  const std::uint64_t id = runs_->run(std::move(plan.sweep), plan.points);
  panel_->setRunning(true);
  showPlan();
  showSweep(id);
}

void SweepController::end(quint64 id) {
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

void SweepController::showPlots() {
  const Sweep nothing;
  const Sweep& sweep = current() ? *current() : nothing;
  panel_->setMeasures(measure_names(sweep), 0, 1);
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
void SweepController::choose(int plot, const PlotPlace& chosen) {
  const auto& places = charts_.at(static_cast<std::size_t>(plot)).places;
  const SweepChart::Place place = places.at(chosen.series).at(chosen.point);
  const auto& scenes = current()->scenes;
  const auto seen = std::ranges::find(scenes, bench_.session.generation(), &SweepScene::scene);
  const auto usual = seen == scenes.end() ? 0 : static_cast<std::size_t>(seen - scenes.begin());
  showPoint({place.scene.value_or(usual), place.point});
}

void SweepController::showPoint(SweepPlace place) {
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

void SweepController::showMap(SweepPlace place, const EstimatePtr& map) {
  dropShown();
  Session& session = bench_.session;
  const SweepPoint& point = *bench_.scenes.sweeps().find(current_, place);
  const int id = session.add_estimate(map, point.display_range, session.generation());
  session.show_estimate(id);  // it was asked for
  session.rename_estimate(id, name_of(*current(), point).toStdString());
  shown_[session.generation()] = {id, session.find_estimate(id)->name};
  bench_.overlay.showResults();
}

void SweepController::runAgain(SweepPlace place) {
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
        if (!sweeps.find(id, place) || sweeps.find(id)->scenes[place.scene].scene != scene) return;
        sweeps.set_map(id, place, finished.estimate);
        if (id != current_ || chosen_ != place || bench_.session.generation() != scene) return;
        showMap(place, finished.estimate);
        describe();
      });
  bench_.jobs.setScene(job, bench_.session.generation());
}

// Keeps results that the user named, annotated or saved.
void SweepController::dropShown() {
  Session& session = bench_.session;
  const Shown former = std::exchange(shown_[session.generation()], {});
  const EstimateEntry* entry = session.find_estimate(former.id);
  if (!entry || entry->name != former.name || !entry->note.empty() || entry->is_saved) return;
  session.remove_estimate(former.id);
}

SweepController::Shown SweepController::shownHere() const {
  const auto found = shown_.find(bench_.session.generation());
  return found == shown_.end() ? Shown() : found->second;
}

void SweepController::describe() {
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

void SweepController::keep() {
  const Shown kept = std::exchange(shown_[bench_.session.generation()], {});
  bench_.messages.hint(
      tr("%1 stays in the list of results.").arg(QString::fromStdString(kept.name)));
  describe();
}

void SweepController::use() {
  const Sweep& sweep = *current();
  const SweepPoint& point = *bench_.scenes.sweeps().find(current_, *chosen_);
  method_.setRequest({sweep.base.method, values_at(sweep.base.parameters, point.point),
                      method_.request().all_views});
  showMethod();
  bench_.messages.hint(tr("The form of the Estimate tab has the values of this point."));
}

void SweepController::save() {
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

namespace {

struct SweepPlotText {
  Q_DECLARE_TR_FUNCTIONS(episcope::SweepPlot)
};

struct Measured {
  SweepMeasure measure;
  const char* name;
};
// Measures in the order of the lists, first those that need ground truth.
constexpr Measured kMeasures[] = {
    {SweepMeasure::MseTimes100,
     QT_TRANSLATE_NOOP("episcope::SweepPlot", "MSE×100, all pixels [px²]")},
    {SweepMeasure::BadPix007, QT_TRANSLATE_NOOP("episcope::SweepPlot", "BadPix 0.07, 2016 [%]")},
    {SweepMeasure::BadPix003, QT_TRANSLATE_NOOP("episcope::SweepPlot", "BadPix 0.03, 2016 [%]")},
    {SweepMeasure::BadPix001, QT_TRANSLATE_NOOP("episcope::SweepPlot", "BadPix 0.01, 2016 [%]")},
    {SweepMeasure::Change, QT_TRANSLATE_NOOP("episcope::SweepPlot", "Change of the map [px]")},
    {SweepMeasure::Seconds, QT_TRANSLATE_NOOP("episcope::SweepPlot", "Time [s]")}};
constexpr int kOfTruth = 4;  // of them

bool has_points(const Sweep& sweep) {
  return std::ranges::any_of(sweep.scenes, [](const auto& each) { return !each.points.empty(); });
}

std::span<const Measured> measures_of(const Sweep& sweep) {
  const std::span all(kMeasures);
  const bool is_judged = std::ranges::any_of(sweep.scenes, has_truth);
  return is_judged || !has_points(sweep) ? all : all.subspan(kOfTruth);
}

// NaN where there is none, which is not drawn.
using Value = std::function<std::optional<double>(std::size_t point)>;

// As the form names the second parameter; empty with one.
QString line_name(const Sweep& sweep, const SweepLine& line) {
  if (!line.second) return {};
  return labeled_value_text(find_estimator(sweep.base.method).parameters, sweep.swept[1].key,
                            *line.second);
}

void add_line(SweepChart& chart, const SweepLine& line, const QString& name,
              std::optional<std::size_t> scene, const Value& value) {
  PlotSeries& series = chart.plot.series.emplace_back();
  series.name = name;
  auto& places = chart.places.emplace_back();
  for (const SweepLine::Place& place : line.places) {
    series.points.emplace_back(place.x, value(place.point).value_or(qQNaN()));
    places.push_back({scene, place.point});
  }
}

void add_scene(SweepChart& chart, const Sweep& sweep, std::size_t place, SweepMeasure measure,
               bool is_named) {
  const SweepScene& scene = sweep.scenes[place];
  const auto value = [&](std::size_t point) { return measure_of(scene.points[point], measure); };
  for (const SweepLine& line : lines_of(scene.points, sweep.swept)) {
    const QString name = is_named ? QString::fromStdString(scene.name) : line_name(sweep, line);
    add_line(chart, line, name, place, value);
  }
}

void add_mean(SweepChart& chart, const Sweep& sweep, SweepMeasure measure) {
  const auto& all = sweep.scenes.front().points;
  const auto count = static_cast<std::ptrdiff_t>(common_count(sweep.scenes));
  const std::vector<SweepPoint> common(all.begin(), all.begin() + count);
  const auto value = [&](std::size_t point) { return mean_of(sweep.scenes, point, measure); };
  for (const SweepLine& line : lines_of(common, sweep.swept)) {
    const QString name = line_name(sweep, line);
    add_line(chart, line, name.isEmpty() ? SweepPlotText::tr("Mean") : name, std::nullopt, value);
  }
}

}  // namespace

QString axis_text(const ParameterDescription& description) {
  const QString label = schema_text(description.label);
  return description.unit.empty() ? label
                                  : QString("%1 [%2]").arg(label, schema_text(description.unit));
}

QStringList measure_names(const Sweep& sweep) {
  QStringList names;
  for (const Measured& each : measures_of(sweep)) names << SweepPlotText::tr(each.name);
  return names;
}

QStringList scene_choices(const Sweep& sweep) {
  if (sweep.scenes.size() < 2) return {};
  QStringList names{sweep.swept.size() < 2 ? SweepPlotText::tr("Each and the mean")
                                           : SweepPlotText::tr("Mean")};
  for (const SweepScene& each : sweep.scenes) names << QString::fromStdString(each.name);
  return names;
}

SweepChart chart_of(const Sweep& sweep, int measure, int choice) {
  SweepChart chart;
  const auto measures = measures_of(sweep);
  if (sweep.scenes.empty() || measure < 0 || measure >= std::ssize(measures)) return chart;
  for (const ParameterDescription& each : find_estimator(sweep.base.method).parameters) {
    if (each.key == sweep.swept.front().key) chart.plot.x = {axis_text(each), each.logarithmic};
  }
  const Measured& measured = measures[static_cast<std::size_t>(measure)];
  chart.plot.y = {SweepPlotText::tr(measured.name)};
  const bool is_one = sweep.scenes.size() == 1;
  if (is_one || (choice > 0 && choice <= std::ssize(sweep.scenes))) {
    const int place = is_one ? 0 : choice - 1;
    add_scene(chart, sweep, static_cast<std::size_t>(place), measured.measure, false);
    return chart;
  }
  for (std::size_t i = 0; sweep.swept.size() < 2 && i < sweep.scenes.size(); ++i) {
    add_scene(chart, sweep, i, measured.measure, true);
  }
  add_mean(chart, sweep, measured.measure);
  return chart;
}

std::optional<PlotPlace> place_in(const SweepChart& chart, SweepPlace point) {
  std::optional<PlotPlace> mean;
  for (std::size_t line = 0; line < chart.places.size(); ++line) {
    for (std::size_t i = 0; i < chart.places[line].size(); ++i) {
      const SweepChart::Place& each = chart.places[line][i];
      if (each.point != point.point) continue;
      if (each.scene == point.scene) return PlotPlace{line, i};
      if (!each.scene) mean = {line, i};
    }
  }
  return mean;
}

/// " (10 of 20 runs)" of a sweep that has not been finished; else empty.
QString unfinished_text(const Sweep& sweep) {
  const auto& parameters = find_estimator(sweep.base.method).parameters;
  const auto described = described_under(parameters, sweep.base.parameters);
  const std::size_t planned =
      sweep_points(described, sweep.base.parameters, sweep.swept).size() * sweep.scenes.size();
  const std::size_t done = point_count(sweep);
  return done < planned ? SweepPlotText::tr(" (%1 of %2 runs)").arg(done).arg(planned) : QString();
}

QString title_of(const Sweep& sweep) {
  const Estimator& estimator = find_estimator(sweep.base.method);
  QStringList parts{QString::fromStdString(estimator.info.name)};
  for (const SweptParameter& each : sweep.swept) {
    parts << parameter_label(estimator.parameters, each.key);
  }
  const QString what = parts.join(", ");
  if (sweep.scenes.size() > 1)
    return SweepPlotText::tr("%1 · %2 light fields").arg(what).arg(sweep.scenes.size()) +
           unfinished_text(sweep);
  return sweep.scenes.empty()
             ? what
             : QString("%1 · %2").arg(what, QString::fromStdString(sweep.scenes.front().name)) +
                   unfinished_text(sweep);
}

QString name_of(const Sweep& sweep, const SweepPoint& point) {
  const Estimator& method = find_estimator(sweep.base.method);
  QStringList texts{QString::fromStdString(method.info.name)};
  for (const auto& [key, value] : point.point) {
    texts << labeled_value_text(method.parameters, key, value);
  }
  return texts.join(", ");
}

QString text_of(const Sweep& sweep, SweepPlace place) {
  const SweepScene& scene = sweep.scenes[place.scene];
  const SweepPoint& point = scene.points[place.point];
  QStringList texts;
  if (sweep.scenes.size() > 1) texts << QString::fromStdString(scene.name);
  texts << name_of(sweep, point);
  if (!point.problem.empty()) texts << QString::fromStdString(point.problem);
  if (const auto mse = measure_of(point, SweepMeasure::MseTimes100)) {
    texts << SweepPlotText::tr("MSE×100 %1").arg(number_text(*mse, 3));
  }
  if (const auto bad = measure_of(point, SweepMeasure::BadPix007)) {
    texts << SweepPlotText::tr("BadPix %1 %").arg(number_text(*bad, 2));
  }
  if (point.seconds > 0) texts << SweepPlotText::tr("%1 s").arg(number_text(point.seconds, 2));
  return texts.join(" · ");
}

}  // namespace episcope

#include "moc_sweep_controller.cpp"
