// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/estimate/sweep_controller.h"

#include "app/gui/estimate/method_runs.h"
#include "app/gui/frame/dialogs.h"
#include "app/gui/frame/frame.h"
#include "app/gui/frame/jobs.h"
#include "app/gui/frame/messages.h"
#include "app/gui/frame/queued_post.h"
#include "app/gui/frame/text_file.h"
#include "app/gui/opening/scene_switcher.h"
#include "app/session/run/command_line.h"
#include "app/session/session.h"
#include "app/session/sweep/sweep_values.h"
#include "engine/core/error.h"
#include "engine/core/text/join.h"
#include "engine/disparity/registry.h"
#include "widgets/estimate/method_panel.h"
#include "widgets/estimate/parameter_form.h"
#include "widgets/style/number_text.h"
#include "widgets/sweep/sweep_panel.h"

#include <QPointer>

#include <algorithm>
#include <iterator>
#include <utility>

namespace episcope {
namespace {

// Maps beyond it are computed again when their point is chosen: 64 points of 512×512 px fit.
constexpr std::size_t kMapBudget = std::size_t{256} << 20;

std::vector<ParameterDescription> descriptions_of(const RunRequest& request) {
  return described_under(find_estimator(request.method).parameters, request.values);
}

// Proposals are around the value of the form.
ParameterDescription at_present(ParameterDescription description, const ParameterSet& values) {
  const auto present = std::ranges::find(values, description.key, &ParameterSet::value_type::first);
  if (present != values.end()) description.default_value = present->second;
  return description;
}

std::size_t bytes_of(const std::vector<SweepPoint>& points) {
  std::size_t bytes = 0;
  for (const SweepPoint& point : points) {
    if (point.estimate) bytes += byte_size(*point.estimate);
  }
  return bytes;
}

}  // namespace

SweepController::SweepController(const Workbench& bench, MethodPanel& method)
    : QObject(&bench.owner), bench_(bench), method_(method) {
  addTab();
  connectPanel();
  bench.session.on_changed([this](Parts parts) { update(parts); });
  showMethod();
  showPlots();
}

void SweepController::addTab() {
  panel_ = new SweepPanel(&bench_.frame);
  bench_.frame.addTab({.id = "sweep",
                       .title = tr("Sweep"),
                       .command_text = tr("Sweep tab"),
                       .command_tip = tr("Tries values of one or two parameters of the method"),
                       .widget = panel_,
                       .waits = true,
                       .key = tr("Ctrl+Shift+F5")});
}

void SweepController::connectPanel() {
  connect(&method_, &MethodPanel::methodChanged, this, &SweepController::showMethod);
  connect(method_.form(), &ParameterForm::valuesChanged, this, &SweepController::showPlan);
  connect(&bench_.frame, &Frame::tabShown, this, &SweepController::showMethod);
  connect(panel_, &SweepPanel::planEdited, this, &SweepController::showPlan);
  connect(panel_, &SweepPanel::runRequested, this, &SweepController::run);
  connect(panel_, &SweepPanel::cancelRequested, this, [this] { bench_.jobs.cancel(job_); });
  connect(panel_, &SweepPanel::measureChosen, this, &SweepController::showPlots);
  connect(panel_, &SweepPanel::pointChosen, this, &SweepController::choose);
  connect(panel_, &SweepPanel::keepRequested, this, &SweepController::keep);
  connect(panel_, &SweepPanel::useRequested, this, &SweepController::use);
  connect(panel_, &SweepPanel::exportRequested, this, &SweepController::save);
}

void SweepController::update(Parts parts) {
  if (parts.has(Part::Scene)) {
    showPlan();
    if (sweep_.points.empty()) showPlots();
  }
  const bool is_gone = sweep_.scene != 0 && !bench_.session.find_scene(sweep_.scene);
  if (parts.has(Part::Scenes) && is_gone) {
    bench_.jobs.cancel(job_);
    sweep_ = {};
    shown_ = {};
    chosen_.reset();
    showPlots();
  }
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
                    tr("%1, other values as in the Estimate tab")
                        .arg(QString::fromStdString(find_estimator(request.method).info.name)),
                    parameters);
  showPlan();
}

Sweep SweepController::planned() const {
  const RunRequest request = method_.request();
  const std::vector<ParameterDescription> descriptions = descriptions_of(request);
  Sweep sweep;
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
  sweep.planned = sweep_points(descriptions, request.values, sweep.swept);
  return sweep;
}

void SweepController::showPlan() {
  if (!bench_.session.scene()) return panel_->setPlan(tr("Open a light field first."), false);
  try {
    const auto count = planned().planned.size();
    panel_->setPlan(tr("%1 runs on the centre view, the present values first").arg(count),
                    job_ == 0);
  } catch (const InvalidInput& error) {
    QString sentence = with_minus(QString::fromUtf8(error.what()));
    if (!sentence.isEmpty()) sentence[0] = sentence[0].toUpper();
    panel_->setPlan(sentence, false);
  }
}

void SweepController::run() {
  if (job_ != 0 || !bench_.session.scene()) return;
  dropShown();
  chosen_.reset();
  sweep_ = planned();
  const Session& session = bench_.session;
  const GroundTruth& truth = *session.scene()->truth;
  sweep_.number = ++last_number_;
  sweep_.scene = session.generation();
  sweep_.scene_name = session.light_field()->info().name;
  sweep_.has_truth = truth.has_disparity() || truth.has_layers();
  job_ = bench_.jobs.start<bool>(
      Lane::Estimate,
      tr("Sweep of %1").arg(QString::fromStdString(find_estimator(sweep_.base.method).info.name)),
      work(sweep_), [](bool) {}, [this, number = sweep_.number] { end(number); });
  panel_->setRunning(true);
  showPlan();
  showPlots();
}

std::function<bool(const Progress&)> SweepController::work(const Sweep& sweep) {
  return [scene = bench_.session.scene(), base = sweep.base, points = sweep.planned,
          post = queued_post(&bench_.jobs), self = QPointer(this),
          number = sweep.number](const Progress& progress) {
    EstimatePtr reference;
    const auto count = static_cast<double>(points.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
      const auto begin = static_cast<double>(i);
      SweepPoint point = run_sweep_point(
          *scene, base, points[i], reference.get(),
          progress.part(begin / count, (begin + 1) / count)
              .titled(std::to_string(i + 1) + " / " + std::to_string(points.size())));
      if (i == 0) reference = point.estimate;
      post([self, number, point = std::move(point)] {
        if (self) self->take(number, point);
      });
    }
    return true;
  };
}

void SweepController::take(std::uint64_t number, SweepPoint point) {
  if (number != sweep_.number) return;
  sweep_.points.push_back(std::move(point));
  if (bytes_of(sweep_.points) > kMapBudget) sweep_.points.back().estimate = nullptr;
  sweep_.lines = lines_of(sweep_.points, sweep_.swept);
  showPlots();
}

void SweepController::end(std::uint64_t number) {
  job_ = 0;
  panel_->setRunning(false);
  showPlan();
  if (number != sweep_.number) return;
  const auto failed = std::ranges::find_if(
      sweep_.points, [](const SweepPoint& point) { return !point.problem.empty(); });
  if (failed != sweep_.points.end()) {
    bench_.messages.warn(tr("%1: %2").arg(QString::fromStdString(name_of(sweep_, *failed)),
                                          QString::fromStdString(failed->problem)));
  }
}

void SweepController::showPlots() {
  panel_->setMeasures(measure_names(sweep_), 0, 1);
  const auto& scene = bench_.session.scene();
  const QString instead = job_ != 0 ? tr("The first point is being computed.")
                          : !scene  ? tr("Open a light field first.")
                          : sweep_.points.empty()
                              ? tr("Run: the points appear here one after the other.")
                              : tr("The points have no such number.");
  const auto [upper, lower] = panel_->measures();
  panel_->setPlots(plot_of(sweep_, upper), plot_of(sweep_, lower), instead);
  panel_->setExportable(!sweep_.points.empty());
  describe();
}

void SweepController::choose(const PlotPlace& place) {
  showPoint(sweep_.lines.at(place.series).places.at(place.point).point);
}

void SweepController::showPoint(std::size_t point) {
  chosen_ = point;
  const SweepPoint& shown = sweep_.points[point];
  if (bench_.session.generation() != sweep_.scene) {
    bench_.scenes.show(sweep_.scene, [this, point, number = sweep_.number] {
      if (number == sweep_.number && bench_.session.generation() == sweep_.scene) showPoint(point);
    });
  } else if (shown.estimate) {
    dropShown();
    shown_.id = bench_.session.add_estimate(shown.estimate, shown.display_range, sweep_.scene);
    bench_.session.rename_estimate(shown_.id, name_of(sweep_, shown));
    shown_.name = bench_.session.find_estimate(shown_.id)->name;
  } else if (shown.problem.empty()) {
    runAgain(point);
  }
  describe();
}

void SweepController::runAgain(std::size_t point) {
  const EstimateRequest request{sweep_.base.method,
                                values_at(sweep_.base.parameters, sweep_.points[point].point),
                                sweep_.base.options};
  bench_.jobs.start<FinishedEstimate>(
      Lane::Estimate, QString::fromStdString(name_of(sweep_, sweep_.points[point])),
      [light_field = bench_.session.light_field(), request](const Progress& progress) {
        return run_estimator(*light_field, request, progress);
      },
      [this, point, number = sweep_.number](const FinishedEstimate& finished) {
        if (number != sweep_.number) return;
        sweep_.points[point].estimate = finished.estimate;
        if (chosen_ == point) showPoint(point);
        if (bytes_of(sweep_.points) > kMapBudget) sweep_.points[point].estimate = nullptr;
      });
}

// What the user named, annotated or saved stays.
void SweepController::dropShown() {
  const Shown former = std::exchange(shown_, {});
  Session& session = bench_.session;
  const EstimateEntry* entry = session.find_estimate(former.id);
  if (!entry || entry->name != former.name || !entry->note.empty() || entry->is_saved) return;
  session.remove_estimate(former.id);
}

void SweepController::describe() {
  if (!chosen_) {
    const QString hint = sweep_.points.empty() ? QString()
                         : sweep_.has_truth    ? tr("Click a point to see its map.")
                                            : tr("No ground truth: click a point to see its map.");
    return panel_->setChosen(std::nullopt, hint, false);
  }
  panel_->setChosen(place_of(sweep_, *chosen_), text_of(sweep_, sweep_.points[*chosen_]),
                    shown_.id != 0);
}

void SweepController::keep() {
  const Shown kept = std::exchange(shown_, {});
  bench_.messages.hint(
      tr("%1 stays in the list of results.").arg(QString::fromStdString(kept.name)));
  describe();
}

void SweepController::use() {
  method_.setRequest({sweep_.base.method,
                      values_at(sweep_.base.parameters, sweep_.points[*chosen_].point),
                      method_.request().all_views});
  showMethod();
  bench_.messages.hint(tr("The form of the Estimate tab has the values of this point."));
}

void SweepController::save() {
  const std::string parameters =
      joined(changed_parameters(sweep_.base.method, sweep_.base.parameters), " ",
             [](const auto& each) { return each.first + "=" + to_text(each.second); });
  const QString text = QString::fromStdString(table_to_csv(sweep_table(
      sweep_.points,
      {{"scene", sweep_.scene_name}, {"method", sweep_.base.method}, {"parameters", parameters}})));
  ask_where_to_save(
      &bench_.window,
      {.name = "save_sweep",
       .title = tr("Save the sweep"),
       .filter = tr("CSV (*.csv)"),
       .proposal =
           QString::fromStdString(sweep_.scene_name + "_" + sweep_.base.method + "_sweep.csv")},
      [this, text](const QString& path) {
        write_in_background(bench_.jobs, bench_.messages, path,
                            [path, text](const Progress&) { write_text_file(path, text); });
      });
}

}  // namespace episcope

#include "moc_sweep_controller.cpp"
