// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/compare/metric_controller.h"

#include "app/gui/compare/metric_names.h"
#include "app/gui/estimate/estimate_controller.h"
#include "app/gui/frame/text_file.h"
#include "widgets/compare/metric_table.h"

#include <QFileDialog>
#include <QVariant>

#include <algorithm>
#include <array>
#include <optional>

namespace episcope {
namespace {

constexpr std::array kProtocols = {Protocol::Vmv2013, Protocol::Benchmark2016};

struct Place {
  Protocol protocol;
  std::string key;
  friend bool operator==(const Place&, const Place&) = default;
};

// Every metric that any result has.
std::vector<Place> places_of(const std::vector<Judged>& judged) {
  std::vector<Place> places;
  for (const Judged& each : judged) {
    for (const auto& [protocol, metrics] : each.metrics) {
      for (const auto& [key, value] : metrics) {
        const Place place{protocol, key};
        if (std::find(places.begin(), places.end(), place) == places.end()) places.push_back(place);
      }
    }
  }
  std::stable_sort(places.begin(), places.end(), [](const Place& a, const Place& b) {
    return metric_rank(a.key) < metric_rank(b.key);
  });
  return places;
}

MetricRow row_of(const Judged& judged, const std::vector<Place>& places) {
  MetricRow row{static_cast<quint64>(judged.id), {QString::fromStdString(judged.name)}};
  for (const Place& place : places) {
    const auto metrics = judged.metrics.find(place.protocol);
    const auto value =
        metrics == judged.metrics.end() ? std::nullopt : find_metric(metrics->second, place.key);
    row.values.push_back(value ? QVariant(*value) : QVariant());
  }
  row.values.push_back(judged.seconds > 0 ? QVariant(judged.seconds) : QVariant());
  return row;
}

}  // namespace

MetricController::MetricController(Session& session, Jobs& jobs, const Panels& panels,
                                   QObject* parent)
    : QObject(parent), session_(session), jobs_(jobs), panels_(panels) {
  connect(panels_.metrics, &MetricTable::rowClicked, this,
          [this](quint64 id) { session_.show_estimate(static_cast<int>(id)); });
  connect(panels_.metrics, &MetricTable::compareRequested, this,
          [this](quint64 id) { session_.compare_with(static_cast<int>(id)); });
  connect(panels_.metrics, &MetricTable::copied, this, [this](const QString& form) {
    const auto count = session_.estimates().size();
    emit hint(count == 1 ? tr("Copied the numbers of one result as %1").arg(form)
                         : tr("Copied the numbers of %1 results as %2").arg(count).arg(form));
  });
  connect(panels_.metrics, &MetricTable::saveRequested, this, &MetricController::save);
  session_.on_changed([this](Parts parts) { update(parts); });
  update(Part::Scene);
}

void MetricController::update(Parts parts) {
  if (parts.has_any(Part::Scene | Part::Estimates | Part::Evaluations)) fillTable();
  if (parts.has_any(Part::Scene | Part::Estimates | Part::Shown | Part::Evaluations)) {
    const EstimateEntry* shown = session_.shown();
    const EstimateEntry* compared = session_.compared();
    panels_.metrics->setSides(shown ? static_cast<quint64>(shown->id) : 0,
                              compared ? static_cast<quint64>(compared->id) : 0);
  }
}

void MetricController::fillTable() {
  const auto& scene = session_.scene();
  if (!scene || (!scene->truth->has_disparity() && !scene->truth->has_layers())) {
    panels_.metrics->setTable({}, {});
    panels_.metrics->setEmptyText(
        scene ? tr("This light field has no ground truth to judge results by.")
              : tr("Open a light field with ground truth and run a method."));
    return;
  }
  panels_.metrics->setEmptyText(tr("Run a method: its errors against the truth appear here."));
  const std::vector<Judged> judged = judgeAll();
  const std::vector<Place> places = places_of(judged);
  std::vector<MetricColumn> columns = {
      {"method", tr("Result"), tr("Name of the result"), 0, BestValue::None}};
  for (const Place& place : places) columns.push_back(metric_column(place.protocol, place.key));
  columns.push_back({"seconds", tr("Time\ns"), tr("Seconds taken"), 2, BestValue::Least});
  std::vector<MetricRow> rows;
  for (const Judged& each : judged) rows.push_back(row_of(each, places));
  panels_.metrics->setTable(columns, rows);
}

std::vector<Judged> MetricController::judgeAll() {
  std::vector<Judged> judged;
  for (const EstimateEntry& entry : session_.estimates()) {
    Judged each{entry.id, entry.name, entry.estimate->seconds, {}};
    for (const Protocol protocol : kProtocols) {
      const auto evaluation =
          session_.evaluation({entry.id, judged_view(*session_.scene()), protocol});
      if (evaluation) each.metrics[protocol] = evaluation->metrics;
    }
    judged.push_back(std::move(each));
  }
  return judged;
}

void MetricController::save(const QString& suffix, const QString& text) {
  auto* dialog = new QFileDialog(panels_.metrics, tr("Save the table"), "metrics." + suffix,
                                 suffix == "csv" ? tr("CSV (*.csv)") : tr("LaTeX (*.tex)"));
  dialog->setAttribute(Qt::WA_DeleteOnClose);
  dialog->setAcceptMode(QFileDialog::AcceptSave);
  dialog->setDefaultSuffix(suffix);
  connect(dialog, &QFileDialog::fileSelected, this, [this, text](const QString& path) {
    jobs_.start<bool>(
        Lane::Export, tr("Saving the table"),
        [path, text](const Progress&) {
          write_text_file(path, text);
          return true;
        },
        [this, path](bool) { emit written(path); });
  });
  dialog->open();
}

}  // namespace episcope
