// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/estimate/estimate_controller.h"

#include "app/gui/estimate/result_export.h"
#include "app/gui/scene/overlay.h"
#include "app/gui/scene/scene_opener.h"
#include "app/gui/scene/viewer_area.h"
#include "app/gui/shell/commands.h"
#include "app/gui/shell/features.h"
#include "app/gui/shell/frame.h"
#include "app/gui/shell/jobs.h"
#include "app/session/command_line.h"
#include "app/session/load_scene.h"
#include "engine/disparity/registry.h"
#include "widgets/controls/layout.h"
#include "widgets/controls/text.h"
#include "widgets/panels/method_panel.h"
#include "widgets/panels/result_list.h"

#include <QAbstractItemView>
#include <QClipboard>
#include <QCoreApplication>
#include <QGuiApplication>
#include <QInputDialog>

#include <algorithm>
#include <cmath>

namespace episcope {
namespace {

std::vector<BatchDialog::Row> method_rows(const std::string& chosen) {
  std::vector<BatchDialog::Row> rows;
  for (const Estimator& each : registered_estimators()) {
    rows.push_back({QString::fromStdString(each.info.id), QString::fromStdString(each.info.name),
                    each.info.id == chosen});
  }
  return rows;
}

std::vector<BatchDialog::Row> scene_rows(const Session& session) {
  std::vector<BatchDialog::Row> rows;
  for (const OpenScene* each : session.scenes()) {
    rows.push_back({QString::number(each->id), QString::fromStdString(each->name), true});
  }
  return rows;
}

EstimateRequest default_request(const std::string& method) {
  return {method, {}, {.views = views_of(find_estimator(method).info.all_views)}};
}

// Asks for methods and open scenes and runs all of them. `form` holds the parameters of the method
// that the form shows, which is proposed; the others run with their defaults.
void ask_for_batch(const Workbench& bench, MethodRuns& runs, const RunRequest& form) {
  auto* dialog =
      new BatchDialog(method_rows(form.method), scene_rows(bench.session), &bench.window);
  dialog->setAttribute(Qt::WA_DeleteOnClose);
  QObject::connect(dialog, &QDialog::accepted, &runs, [bench, &runs, form, dialog] {
    for (const QString& method : dialog->methods()) {
      const std::string id = method.toStdString();
      const EstimateRequest request = id == form.method ? request_of(form) : default_request(id);
      for (const QString& scene : dialog->scenes()) {
        if (const auto* open = bench.session.find_scene(scene.toULongLong())) {
          runs.run(request, *open);
        }
      }
    }
  });
  dialog->open();
}

constexpr const char* kFirstMethod = "epi_l";
constexpr int kLeastResults = 150;  // height of a list of five

std::vector<MethodDescription> described_methods() {
  std::vector<MethodDescription> methods;
  for (const Estimator& estimator : registered_estimators()) {
    const EstimatorInfo& info = estimator.info;
    methods.push_back({info.id, info.name, info.summary, info.reference, info.all_views,
                       estimator.parameters, info.main_parameters});
  }
  return methods;
}

QString detail_text(const Estimate& estimate) {
  QStringList lines;
  const GridShape grid = estimate.field.disparity.grid();
  lines << (grid.count() == 1 ? EstimateController::tr("One view")
                              : EstimateController::tr("%1×%2 views").arg(grid.v).arg(grid.u));
  if (estimate.range.length() > 0) {
    lines << EstimateController::tr("Searched %1 … %2 px")
                 .arg(number_text(estimate.range.min, 2), number_text(estimate.range.max, 2));
  }
  for (const auto& [key, value] : estimate.parameters) {
    lines << named_value(estimate, key, value);
  }
  for (const std::string& note : estimate.notes) lines << finding_words(note);
  return lines.join('\n');
}

}  // namespace

EstimateController::EstimateController(const Workbench& bench)
    : QObject(&bench.owner), bench_(bench), session_(bench.session), runs_(bench) {
  addTab();
  addCommands();
  add_measured_range(bench_, method_);
  add_method_range(bench_, *method_);
  method_->setMethods(described_methods());
  addTargets();
  new LiveController(bench, *method_);
  add_sweeps(bench, *method_);
  connect(method_, &MethodPanel::runRequested, this,
          [this](const RunRequest& request) { run(request_of(request)); });
  connect(method_, &MethodPanel::cancelRequested, this, &EstimateController::cancel);
  connect(method_, &MethodPanel::copyCommandRequested, this, &EstimateController::copyCommand);
  connectResults();
  connect(&runs_, &MethodRuns::changed, this, &EstimateController::showRunning);
  connect(&bench.viewer_area, &ViewerArea::previewChanged, this, [this] {
    update(Part::Scene);
    bench_.commands.refresh();
  });
  connect(&bench.opener, &SceneOpener::opened, this, &EstimateController::runFirst);
  connect(&bench.frame, &Frame::started, this, [this] { is_settled_ = false; });
  connect(&bench.frame, &Frame::settled, this, [this] {
    if (!std::exchange(is_settled_, true) && session_.scene() && session_.estimates().empty()) {
      runFirst(QString::fromStdString(session_.input()));
    }
  });
  session_.on_changed([this](Parts parts) { update(parts); });
  update(Part::Scene);
}

// A built-in scene is estimated at once, so that there is something to see; while earlier work is
// offered, not before that is decided. Photographs of the gantry are rectified first.
void EstimateController::runFirst(const QString& input) {
  const std::string id = builtin_scene_id(input.toStdString());
  const OpenScene* shown = session_.find_scene(session_.generation());
  if (!shown || !is_settled_ || id.empty() || is_gantry(id)) return;
  runs_.run({kFirstMethod, {}, {}}, *shown, false);
}

void EstimateController::addTargets() {
  bench_.commands.addTargets([this] {
    std::vector<PaletteTarget> found;
    for (const Estimator& estimator : registered_estimators()) {
      const EstimatorInfo& info = estimator.info;
      found.push_back(
          {tr("Method: %1").arg(QString::fromStdString(info.name)), schema_text(info.summary),
           QString::fromStdString(info.id + ' ' + info.reference), [this, id = info.id] {
             bench_.frame.showTab("estimate");
             method_->setCurrentMethod(id);
           }});
    }
    return found;
  });
}

void EstimateController::addTab() {
  auto* tab = new FittingSplitter(kLeastResults, &bench_.frame);
  method_ = new MethodPanel(tab);
  results_ = new ResultList(tab);
  tab->addWidget(method_);
  tab->addWidget(results_);
  bench_.frame.addTab({.id = "estimate",
                       .title = tr("Estimate"),
                       .page = tr("Method"),
                       .command_text = tr("Estimate tab"),
                       .command_tip = tr("Shows methods and results"),
                       .widget = tab});
  bench_.commands.hearHeldKeys(results_->findChild<QAbstractItemView*>());
}

void EstimateController::connectResults() {
  connect(results_, &ResultList::selected, this, [this](quint64 id) {
    const int row = static_cast<int>(id);
    const EstimateEntry* entry = session_.find_estimate(row);
    entry && entry->is_new ? runs_.show(row) : session_.show_estimate(row);
  });
  connect(results_, &ResultList::compareRequested, this,
          [this](quint64 id) { session_.compare_with(static_cast<int>(id)); });
  connect(results_, &ResultList::removeRequested, this,
          [this](quint64 id) { remove(static_cast<int>(id)); });
  connect(results_, &ResultList::renameRequested, this, [this](quint64 id, const QString& name) {
    session_.rename_estimate(static_cast<int>(id), name.trimmed().toStdString());
    listResults();  // the row holds what was typed
  });
  const auto with_entry = [this](auto act) {
    return [this, act](quint64 id) {
      if (const auto* entry = session_.find_estimate(static_cast<int>(id))) act(*entry);
    };
  };
  connect(results_, &ResultList::exportRequested, this,
          with_entry([this](const EstimateEntry& entry) { ask_to_export(bench_, entry); }));
  connect(results_, &ResultList::copyCommandRequested, this,
          with_entry([this](const EstimateEntry& entry) {
            copy(command_line_for(*entry.estimate, session_.input(), session_.reading_options()));
          }));
  connect(results_, &ResultList::noteRequested, this,
          with_entry([this](const EstimateEntry& entry) { askForNote(entry); }));
  connect(results_, &ResultList::reuseRequested, this,
          with_entry([this](const EstimateEntry& entry) { reuse(entry); }));
}

void EstimateController::askForNote(const EstimateEntry& entry) {
  auto* dialog = named("result_note", new QInputDialog(&bench_.window));
  dialog->setAttribute(Qt::WA_DeleteOnClose);
  dialog->setWindowTitle(tr("Note"));
  dialog->setLabelText(tr("Note on %1:").arg(QString::fromStdString(entry.name)));
  dialog->setOption(QInputDialog::UsePlainTextEditForTextInput);
  dialog->setTextValue(QString::fromStdString(entry.note));
  connect(dialog, &QInputDialog::textValueSelected, this,
          [this, id = entry.id](const QString& text) {
            session_.set_note(id, text.trimmed().toStdString());
          });
  dialog->open();
}

void EstimateController::run() {
  if (!session_.scene()) return;
  if (const RunRequest request = method_->request(); !request.method.empty()) {
    run(request_of(request));
  }
}

void EstimateController::run(const EstimateRequest& request) {
  if (const OpenScene* shown = session_.find_scene(session_.generation()))
    runs_.run(request, *shown);
}

void EstimateController::showRunning() {
  const bool is_running = runs_.isRunning(session_.generation());
  method_->setRunning(is_running);
  results_->setExpecting(is_running);
}

void EstimateController::cancel() {
  bench_.job_cancel.cancel(runs_.jobsOn(session_.generation()));
}

void EstimateController::remove(int id) {
  const auto& entries = session_.estimates();
  const auto found = std::ranges::find(entries, id, &EstimateEntry::id);
  if (found == entries.end()) return;
  removed_.push_back(
      {*found, static_cast<std::size_t>(found - entries.begin()), session_.generation()});
  session_.remove_estimate(id);
  bench_.messages.offer(tr("Removed: %1").arg(QString::fromStdString(removed_.back().entry.name)),
                        tr("Undo"), [this] { restoreRemoved(); });
}

bool EstimateController::canRestore() const {
  return std::ranges::count(removed_, session_.generation(), &Removed::scene) > 0;
}

void EstimateController::restoreRemoved() {
  if (!canRestore()) return;
  const auto found =
      std::ranges::find(removed_.rbegin(), removed_.rend(), session_.generation(), &Removed::scene);
  Removed last = std::move(*found);
  removed_.erase(std::prev(found.base()));
  session_.restore_estimate(std::move(last.entry), last.place);
}

void EstimateController::showNeighbour(int step) {
  const auto& entries = session_.estimates();
  const int count = static_cast<int>(entries.size());
  for (int i = 0; i < count; ++i) {
    if (!session_.shown() || entries[i].id != session_.shown()->id) continue;
    session_.show_estimate(entries[(i + step + count) % count].id);
    return;
  }
}

void EstimateController::update(Parts parts) {
  if (parts.has(Part::Scenes)) {
    std::erase_if(removed_,
                  [this](const Removed& each) { return !session_.find_scene(each.scene); });
  }
  if (parts.has(Part::Scene)) {
    method_->setRunBlocked(why_nothing_runs(bench_.session, bench_.viewer_area));
    showRunning();
  }
  if (parts.has_any(Part::Scene | Part::Estimates | Part::Evaluations | Part::View | Part::Live)) {
    listResults();
  }
  if (parts.has_any(Part::Scene | Part::Estimates | Part::Shown | Part::Live)) showChoice();
}

void EstimateController::showChoice() {
  const auto row_of = [this](const EstimateEntry* entry) {
    return entry ? std::optional(rowId(*entry)) : std::nullopt;
  };
  results_->setShown(row_of(session_.side_a()), row_of(session_.side_b()));
}

quint64 EstimateController::rowId(const EstimateEntry& entry) const {
  return &entry == session_.live() ? kLiveResult : static_cast<quint64>(entry.id);
}

ResultRow EstimateController::rowOf(const EstimateEntry& entry) const {
  const Estimate& estimate = *entry.estimate;
  ResultRow row;
  row.id = rowId(entry);
  row.method = QString::fromStdString(entry.name);
  row.parameters = parameter_text(estimate);
  row.seconds = estimate.seconds;
  row.detail = detail_text(estimate);
  row.note = QString::fromStdString(entry.note);
  if (!entry.foreign_file.empty()) {
    row.warning = QString::fromStdString(entry.foreign_file.filename().string());
    row.detail += '\n' + foreign_text(entry);
  }
  row.is_new = entry.is_new;
  const EvaluationKey key{entry.id, judged_view(*session_.scene()), Protocol::Vmv2013};
  if (const auto evaluation = session_.evaluation(key)) {
    row.mse_100 = find_metric(evaluation->metrics, "mse_100");
  }
  return row;
}

void EstimateController::listResults() {
  std::vector<ResultRow> rows;
  // Another light field is in sight.
  if (bench_.viewer_area.isPreviewing()) return results_->setResults({});
  for (const EstimateEntry& entry : session_.estimates()) rows.push_back(rowOf(entry));
  if (const EstimateEntry* live = session_.live()) rows.push_back(rowOf(*live));
  results_->setResults(rows);
}

void EstimateController::copyCommand() {
  const RunRequest request = method_->request();
  if (request.method.empty() || !session_.scene()) return;
  copy(command_line_for(request.method, request.values, views_of(request.all_views),
                        session_.input(), session_.reading_options()));
}

void EstimateController::copy(const std::string& command) {
  QGuiApplication::clipboard()->setText(QString::fromStdString(command));
  bench_.messages.hint(tr("Copied: %1").arg(QString::fromStdString(command)));
}

void EstimateController::reuse(const EstimateEntry& entry) {
  const Estimate& estimate = *entry.estimate;
  method_->setRequest(
      {estimate.method, estimate.parameters, estimate.field.disparity.grid().count() > 1});
}

namespace {

constexpr int kMethodSection = 0;
constexpr int kResultSection = 1;

}  // namespace

void EstimateController::addCommands() {
  const auto has_scene = [this] { return session_.scene() != nullptr; };
  const auto can_run = [this] {
    return why_nothing_runs(bench_.session, bench_.viewer_area).isEmpty();
  };
  bench_.commands.add({.menu = Menu::Estimate, .section = kMethodSection},
                      {{.id = "estimate.run",
                        .text = tr("Run"),
                        .tip = tr("Runs the chosen method with the parameters of the form"),
                        .icon = "run",
                        .keys = {Qt::Key_F5, tr("Ctrl+Return")},
                        .run = [this] { run(); },
                        .enabled = can_run},
                       {.id = "estimate.batch",
                        .text = tr("Run on several…"),
                        .tip = tr("Runs one or several methods on open light fields"),
                        .keys = {tr("Shift+F5")},
                        .run = [this] { ask_for_batch(bench_, runs_, method_->request()); },
                        .enabled = has_scene},
                       {.id = "estimate.sweep",
                        .text = tr("Sweep parameters…"),
                        .tip = tr("Runs the method with several values of one or two parameters"),
                        .keys = {tr("Ctrl+Shift+F5")},
                        .run = [this] { bench_.frame.showTab("sweep"); }}});
  QAction* cancel = bench_.commands.add({.id = "estimate.cancel",
                                         .menu = Menu::Estimate,
                                         .text = tr("Cancel"),
                                         .tip = tr("Cancels the current gesture, mode or job"),
                                         .icon = "stop",
                                         .keys = {Qt::Key_Escape},
                                         .run = [&cancels = bench_.cancels] { cancels.cancel(); },
                                         .section = kMethodSection});
  QAction* copy = bench_.commands.add(
      {.id = "estimate.copy_command",
       .menu = Menu::Estimate,
       .text = tr("Copy as command"),
       .tip = tr("Copies the command line that runs the method with the parameters of the form"),
       .icon = "copy",
       .keys = {tr("Ctrl+Shift+C")},
       .run = [this] { copyCommand(); },
       .section = kMethodSection,
       .enabled = can_run});
  method_->followTips(cancel, copy);
  addResultCommands();
}

void EstimateController::addResultCommands() {
  const auto has_result = [this] {
    return session_.shown() != nullptr && !bench_.viewer_area.isPreviewing();
  };
  bench_.commands.add({.menu = Menu::Estimate, .section = kResultSection, .enabled = has_result},
                      {{.id = "estimate.next",
                        .text = tr("Next result"),
                        .tip = tr("Shows the next result of the list"),
                        .keys = {tr("Ctrl+PgDown")},
                        .run = [this] { showNeighbour(1); }},
                       {.id = "estimate.previous",
                        .text = tr("Previous result"),
                        .tip = tr("Shows the previous result of the list"),
                        .keys = {tr("Ctrl+PgUp")},
                        .run = [this] { showNeighbour(-1); }},
                       {.id = "estimate.remove",
                        .text = tr("Remove result"),
                        .tip = tr("Removes the shown result from the list"),
                        .icon = "trash",
                        .keys = {tr("Ctrl+Delete")},
                        .run = [this] { remove(session_.shown()->id); }},
                       {.id = "estimate.restore",
                        .text = tr("Restore removed result"),
                        .tip = tr("Restores the result removed last"),
                        .icon = "undo",
                        .keys = {tr("Ctrl+Shift+Delete")},
                        .run = [this] { restoreRemoved(); },
                        .enabled = [this] { return canRestore(); }},
                       {.id = "estimate.note",
                        .text = tr("Note on result…"),
                        .tip = tr("Writes a note on the shown result, kept with the project"),
                        .keys = {tr("Ctrl+Alt+N")},
                        .run = [this] { askForNote(*session_.shown()); }}});
  bench_.commands.add({.menu = Menu::Export, .section = section::kResults, .enabled = has_result},
                      {{.id = "file.export",
                        .text = tr("Result…"),
                        .tip = tr("Writes the shown result: HDF5, PFM, TIFF or PLY"),
                        .icon = "export",
                        .keys = {tr("Ctrl+E")},
                        .run = [this] { ask_to_export(bench_, *session_.shown()); },
                        .bar = BarSection::Files},
                       {.id = "file.export_submission",
                        .text = tr("Result for a submission…"),
                        .tip = tr("Adds the shown result to a submission to the 2016 benchmark"),
                        .icon = "export",
                        .run = [this] { ask_to_submit(bench_, *session_.shown()); }}});
}

namespace {

constexpr const char* kRange = "range";  // in the schema of every method
constexpr double kLeastLength_px = 0.5;
constexpr double kSteps = 100;       // per px
constexpr int kMeasuredSection = 2;  // of the menu Estimate

struct MeasuredRangeText {
  Q_DECLARE_TR_FUNCTIONS(episcope::MeasuredRange)
};

void take(const Workbench& bench, MethodPanel* panel, RangeEnd end) {
  const EpiMeasurement* measured = current_of(bench.session.place().measured);
  RunRequest request = panel->request();
  const ParameterValue* found = find_value(request.values, kRange);
  if (!measured || !found) return;
  const auto& chosen = std::get<IntervalOrAuto>(*found);
  const Interval range =
      with_end(chosen ? *chosen : bench.session.known_range(), end, measured->disparity_px);
  set_value(request.values, kRange, IntervalOrAuto(range));
  panel->setRequest(request);
  bench.messages.hint(MeasuredRangeText::tr("Disparity range of the next run: %1 … %2 px")
                          .arg(number_text(range.min, 2), number_text(range.max, 2)));
}

}  // namespace

Interval with_end(Interval range, RangeEnd end, double disparity_px) {
  if (range.length() <= 0) range = {disparity_px, disparity_px};
  if (end == RangeEnd::Lower) {
    range.min = std::floor(disparity_px * kSteps) / kSteps;
    if (range.max <= range.min) range.max = range.min + kLeastLength_px;
  } else {
    range.max = std::ceil(disparity_px * kSteps) / kSteps;
    if (range.min >= range.max) range.min = range.max - kLeastLength_px;
  }
  return range;
}

void add_measured_range(const Workbench& bench, MethodPanel* panel) {
  struct Row {
    const char* id;
    QString text;
    QString tip;
    RangeEnd end;
  };
  for (const Row& row : std::initializer_list<Row>{
           {"estimate.range_from", MeasuredRangeText::tr("Use the chosen measurement as minimum"),
            MeasuredRangeText::tr(
                "Makes the chosen measured line the lower end of the disparity range of the "
                "method"),
            RangeEnd::Lower},
           {"estimate.range_to", MeasuredRangeText::tr("Use the chosen measurement as maximum"),
            MeasuredRangeText::tr(
                "Makes the chosen measured line the upper end of the disparity range of the "
                "method"),
            RangeEnd::Upper}}) {
    bench.commands.add(
        {.id = row.id,
         .menu = Menu::Estimate,
         .text = row.text,
         .tip = row.tip,
         .run = [bench, panel, end = row.end] { take(bench, panel, end); },
         .section = kMeasuredSection,
         .enabled = [bench] { return current_of(bench.session.place().measured) != nullptr; }});
  }
}

}  // namespace episcope

#include "moc_estimate_controller.cpp"
