// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/estimate/estimate_controller.h"

#include "app/session/run/command_line.h"
#include "engine/disparity/registry.h"
#include "widgets/controls/job_panel.h"
#include "widgets/estimate/method_panel.h"
#include "widgets/estimate/result_list.h"
#include "widgets/style/number_text.h"

#include <QClipboard>
#include <QGuiApplication>

#include <algorithm>

namespace episcope {
namespace {

std::vector<MethodDescription> described_methods() {
  std::vector<MethodDescription> methods;
  for (const Estimator& estimator : registered_estimators()) {
    const EstimatorInfo& info = estimator.info;
    methods.push_back(
        {info.id, info.name, info.summary, info.reference, info.all_views, estimator.parameters});
  }
  return methods;
}

ViewSelection views_of(bool all_views) {
  return all_views ? ViewSelection::All : ViewSelection::Center;
}

EstimateRequest request_of(const RunRequest& request) {
  return {request.method, request.values, {.views = views_of(request.all_views)}};
}

// What sets this run apart from others: whether it was cut short, and parameters that are not at
// their defaults.
QString parameter_text(const Estimate& estimate) {
  QStringList texts;
  const auto& notes = estimate.notes;
  if (std::find(notes.begin(), notes.end(), kTakenEarly) != notes.end()) {
    texts << EstimateController::tr("ended early");
  }
  for (const auto& [key, value] : changed_parameters(estimate.method, estimate.parameters)) {
    texts << QString::fromStdString(key + " " + to_text(value));
  }
  if (!texts.isEmpty()) return texts.join(", ");
  return estimate.parameters.empty() ? QString() : EstimateController::tr("defaults");
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
    lines << QString::fromStdString(key + " " + to_text(value));
  }
  for (const std::string& note : estimate.notes) lines << with_minus(QString::fromStdString(note));
  return lines.join('\n');
}

}  // namespace

EstimateController::EstimateController(Session& session, Jobs& jobs, const Panels& panels,
                                       QObject* parent)
    : QObject(parent), session_(session), jobs_(jobs), panels_(panels) {
  panels_.method->setMethods(described_methods());
  connect(panels_.method, &MethodPanel::runRequested, this,
          [this](const RunRequest& request) { run(request_of(request)); });
  connect(panels_.method, &MethodPanel::cancelRequested, this, &EstimateController::cancel);
  connect(panels_.method, &MethodPanel::copyCommandRequested, this,
          &EstimateController::copyCommand);
  ResultList* results = panels_.results;
  connect(results, &ResultList::selected, this,
          [this](quint64 id) { session_.show_estimate(static_cast<int>(id)); });
  connect(results, &ResultList::compareRequested, this,
          [this](quint64 id) { session_.compare_with(static_cast<int>(id)); });
  connect(results, &ResultList::removeRequested, this,
          [this](quint64 id) { session_.remove_estimate(static_cast<int>(id)); });
  connect(results, &ResultList::exportRequested, this,
          [this](quint64 id) { emit exportRequested(static_cast<int>(id)); });
  const auto with_entry = [this](void (EstimateController::*act)(const EstimateEntry&)) {
    return [this, act](quint64 id) {
      if (const auto* entry = session_.find_estimate(static_cast<int>(id))) (this->*act)(*entry);
    };
  };
  connect(results, &ResultList::copyCommandRequested, this,
          with_entry(&EstimateController::copyCommandOf));
  connect(results, &ResultList::reuseRequested, this, with_entry(&EstimateController::reuse));
  session_.on_changed([this](Parts parts) { update(parts); });
  update(Part::Scene);
}

void EstimateController::run() {
  if (!session_.scene()) return;
  if (const RunRequest request = panels_.method->request(); !request.method.empty()) {
    run(request_of(request));
  }
}

void EstimateController::run(const EstimateRequest& request) {
  const LightFieldPtr light_field = session_.light_field();
  if (!light_field) return;
  const std::uint64_t generation = session_.generation();
  const EstimatorInfo info = find_estimator(request.method).info;
  const quint64 job = jobs_.start<FinishedEstimate>(
      Lane::Estimate, QString::fromStdString(info.name),
      [light_field, request](const Progress& progress) {
        return run_estimator(*light_field, request, progress);
      },
      [this, generation](const FinishedEstimate& finished) {
        session_.add_estimate(finished.estimate, finished.display_range, generation);
      },
      [this] { showRunning(); });
  if (info.iterative) panels_.jobs->setIterative(job);
  showRunning();
}

void EstimateController::showRunning() {
  const bool is_running = jobs_.count(Lane::Estimate) > 0;
  panels_.method->setRunning(is_running);
  panels_.results->setExpecting(is_running);
}

void EstimateController::cancel() {
  jobs_.cancelLane(Lane::Estimate);
}

void EstimateController::removeShown() {
  if (const EstimateEntry* shown = session_.shown()) session_.remove_estimate(shown->id);
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
  if (parts.has(Part::Scene)) {
    panels_.method->setRunBlocked(session_.scene() ? QString() : tr("Open a light field first."));
  }
  if (parts.has_any(Part::Scene | Part::Estimates | Part::Evaluations | Part::View)) listResults();
  if (parts.has_any(Part::Scene | Part::Estimates | Part::Shown)) {
    const EstimateEntry* shown = session_.shown();
    const EstimateEntry* compared = session_.compared();
    const auto id_of = [](const EstimateEntry* entry) {
      return entry ? std::optional<quint64>(entry->id) : std::nullopt;
    };
    panels_.results->setShown(id_of(shown), id_of(compared));
  }
}

void EstimateController::listResults() {
  std::vector<ResultRow> rows;
  for (const EstimateEntry& entry : session_.estimates()) {
    const Estimate& estimate = *entry.estimate;
    ResultRow row;
    row.id = static_cast<quint64>(entry.id);
    row.method = QString::fromStdString(entry.name);
    row.parameters = parameter_text(estimate);
    row.seconds = estimate.seconds;
    row.detail = detail_text(estimate);
    const EvaluationKey key{entry.id, judged_view(*session_.scene()), Protocol::Vmv2013};
    if (const auto evaluation = session_.evaluation(key)) {
      row.mse_100 = find_metric(evaluation->metrics, "mse_100");
    }
    rows.push_back(row);
  }
  panels_.results->setResults(rows);
}

void EstimateController::copyCommand() {
  const RunRequest request = panels_.method->request();
  if (request.method.empty() || !session_.scene()) return;
  copy(command_line_for(request.method, request.values, views_of(request.all_views),
                        session_.input(), session_.reading_options()));
}

void EstimateController::copyCommandOf(const EstimateEntry& entry) {
  copy(command_line_for(*entry.estimate, session_.input(), session_.reading_options()));
}

void EstimateController::copy(const std::string& command) {
  QGuiApplication::clipboard()->setText(QString::fromStdString(command));
  emit hint(tr("Copied: %1").arg(QString::fromStdString(command)));
}

void EstimateController::reuse(const EstimateEntry& entry) {
  const Estimate& estimate = *entry.estimate;
  panels_.method->setRequest(
      {estimate.method, estimate.parameters, estimate.field.disparity.grid().count() > 1});
}

}  // namespace episcope
