// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/metric_controller.h"

#include "app/gui/estimate_controller.h"
#include "app/gui/text_file.h"
#include "widgets/metric_table.h"

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

QString protocol_text(Protocol protocol) {
  return protocol == Protocol::Vmv2013 ? MetricController::tr("2013")
                                       : MetricController::tr("2016");
}

QString metric_label(const std::string& key) {
  if (key == "mse_100") return MetricController::tr("MSE ×100");
  if (key == "badpix_0010") return MetricController::tr("BadPix 0.01 %");
  if (key == "badpix_0030") return MetricController::tr("BadPix 0.03 %");
  if (key == "badpix_0070") return MetricController::tr("BadPix 0.07 %");
  if (key == "q_25_100") return MetricController::tr("Q25 ×100");
  if (key == "density") return MetricController::tr("density %");
  return QString::fromStdString(key);
}

QString metric_help(const Place& place) {
  const QString protocol =
      place.protocol == Protocol::Vmv2013
          ? MetricController::tr("Protocol vmv2013: all pixels with truth, centre view")
          : MetricController::tr("Protocol benchmark2016: without a border of 15 px, centre view");
  return QString::fromStdString(place.key) + '\n' + protocol;
}

MetricColumn column_of(const Place& place) {
  const QString protocol = protocol_name(place.protocol);
  return {protocol + '.' + QString::fromStdString(place.key),
          protocol_text(place.protocol) + '\n' + metric_label(place.key), metric_help(place), 3};
}

}  // namespace

MetricController::MetricController(Session& session, Jobs& jobs, const Panels& panels,
                                   QObject* parent)
    : QObject(parent), session_(session), jobs_(jobs), panels_(panels) {
  connect(panels_.metrics, &MetricTable::rowClicked, this,
          [this](quint64 id) { session_.show_estimate(static_cast<int>(id)); });
  connect(panels_.metrics, &MetricTable::saveRequested, this, &MetricController::save);
  session_.on_changed([this](Parts parts) { update(parts); });
  update(Part::Scene);
}

void MetricController::update(Parts parts) {
  if (parts.has_any(Part::Scene | Part::Estimates | Part::Evaluations)) fillTable();
  if (parts.has_any(Part::Scene | Part::Estimates | Part::Shown)) {
    const EstimateEntry* shown = session_.shown();
    panels_.metrics->setCurrent(shown ? static_cast<quint64>(shown->id) : 0);
  }
}

void MetricController::fillTable() {
  const auto& scene = session_.scene();
  if (!scene || !scene->truth->has_disparity()) {
    panels_.metrics->setTable({}, {});
    panels_.metrics->setEmptyText(
        scene ? tr("This light field has no ground truth to judge results by.")
              : tr("Open a light field with ground truth and run a method."));
    return;
  }
  panels_.metrics->setEmptyText(tr("Run a method: its errors against the truth appear here."));
  std::vector<Place> places;
  std::vector<std::pair<const EstimateEntry*, std::array<EvaluationPtr, kProtocols.size()>>> judged;
  for (const EstimateEntry& entry : session_.estimates()) {
    std::array<EvaluationPtr, kProtocols.size()> evaluations;
    for (std::size_t i = 0; i < kProtocols.size(); ++i) {
      evaluations[i] = session_.evaluation({entry.id, judged_view(session_), kProtocols[i]});
      if (!evaluations[i]) continue;
      for (const auto& [key, value] : evaluations[i]->metrics) {
        const Place place{kProtocols[i], key};
        if (std::find(places.begin(), places.end(), place) == places.end()) places.push_back(place);
      }
    }
    judged.emplace_back(&entry, evaluations);
  }
  std::stable_sort(places.begin(), places.end(),
                   [](const Place& a, const Place& b) { return a.protocol < b.protocol; });
  std::vector<MetricColumn> columns = {{"method", tr("Result"), tr("Name of the result"), 0},
                                       {"seconds", tr("Time\ns"), tr("Seconds taken"), 2}};
  for (const Place& place : places) columns.push_back(column_of(place));
  std::vector<MetricRow> rows;
  for (const auto& [entry, evaluations] : judged) {
    MetricRow row{static_cast<quint64>(entry->id), {QString::fromStdString(entry->name)}};
    const double seconds = entry->estimate->seconds;
    row.values.push_back(seconds > 0 ? QVariant(seconds) : QVariant());
    for (const Place& place : places) {
      const auto& evaluation = evaluations[place.protocol == kProtocols[0] ? 0 : 1];
      const auto value = evaluation ? find_metric(evaluation->metrics, place.key) : std::nullopt;
      row.values.push_back(value ? QVariant(*value) : QVariant());
    }
    rows.push_back(std::move(row));
  }
  panels_.metrics->setTable(columns, rows);
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
        [](bool) {});
  });
  dialog->open();
}

}  // namespace episcope
