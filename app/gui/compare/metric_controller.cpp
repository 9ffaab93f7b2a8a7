// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/compare/metric_controller.h"

#include "app/gui/compare/metric_names.h"
#include "app/gui/compare/region_controller.h"
#include "app/gui/frame/dialogs.h"
#include "app/gui/frame/messages.h"
#include "app/gui/frame/text_file.h"
#include "app/session/run/command_line.h"
#include "app/session/run/run_estimator.h"
#include "widgets/compare/metric_table.h"

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
  for (const auto& [protocol, pixels] : judged.pixels) {
    row.values.push_back(static_cast<double>(pixels));
  }
  row.values.push_back(judged.seconds > 0 ? QVariant(judged.seconds) : QVariant());
  return row;
}

}  // namespace

MetricController::MetricController(const Workbench& bench, MetricTable* table,
                                   const RegionController& region)
    : QObject(&bench.owner),
      bench_(bench),
      session_(bench.session),
      table_(table),
      region_(region),
      part_job_(this) {
  connect(table_, &MetricTable::rowClicked, this,
          [this](quint64 id) { session_.show_estimate(static_cast<int>(id)); });
  connect(table_, &MetricTable::compareRequested, this,
          [this](quint64 id) { session_.compare_with(static_cast<int>(id)); });
  connect(table_, &MetricTable::copied, this, [this](const QString& form) {
    const auto count = session_.estimates().size();
    bench_.messages.hint(count == 1
                             ? tr("Copied the numbers of one result as %1").arg(form)
                             : tr("Copied the numbers of %1 results as %2").arg(count).arg(form));
  });
  connect(table_, &MetricTable::saveRequested, this, &MetricController::save);
  connect(&region_, &RegionController::changed, this, [this] {
    scored_.clear();
    update(Part::Evaluations);
  });
  session_.on_changed([this](Parts parts) { update(parts); });
  update(Part::Scene);
}

void MetricController::update(Parts parts) {
  if (parts.has(Part::Scene)) {
    told_.clear();
    scored_.clear();
  }
  const Parts of_rows = Part::Scene | Part::Estimates | Part::Evaluations | Part::Live;
  if (parts.has_any(of_rows)) fillTable();
  if (parts.has_any(of_rows | Part::Shown)) {
    const EstimateEntry* shown = session_.side_a();
    const EstimateEntry* compared = session_.side_b();
    table_->setSides(shown ? static_cast<quint64>(shown->id) : 0,
                     compared ? static_cast<quint64>(compared->id) : 0);
  }
}

void MetricController::fillTable() {
  const auto& scene = session_.scene();
  if (!scene || (!scene->truth->has_disparity() && !scene->truth->has_layers())) {
    table_->setTable({}, {});
    table_->setEmptyText(scene ? tr("This light field has no ground truth to compare results with.")
                               : tr("Open a light field with ground truth and run a method."));
    return;
  }
  table_->setEmptyText(tr("Run a method: its errors against the ground truth appear here."));
  const std::vector<Judged> judged = judgeAll();
  const std::vector<Place> places = places_of(judged);
  std::vector<MetricColumn> columns = {
      {"method", tr("Result"), tr("Name of the result"), 0, BestValue::None}};
  for (const Place& place : places) columns.push_back(metric_column(place.protocol, place.key));
  addPixels(columns);
  columns.push_back({"seconds", tr("Time\ns"), tr("Seconds taken"), 2, BestValue::Least});
  const auto add_text = [&columns](const QString& key, const QString& label) {
    columns.push_back({key, label, {}, 0, BestValue::None, false});
  };
  add_text("region", tr("Judged"));
  add_text("scene", tr("Scene"));
  add_text("method_id", tr("Method"));
  add_text("parameters", tr("Parameters"));
  add_text("ended_early", tr("Ended early"));
  add_text("note", tr("Note"));
  std::vector<MetricRow> rows;
  for (const Judged& each : judged) {
    rows.push_back(row_of(each, places));
    for (const QString& cell : provenanceOf(*session_.find_estimate(each.id))) {
      rows.back().values.emplace_back(cell);
    }
  }
  table_->setTable(columns, rows);
}

void MetricController::addPixels(std::vector<MetricColumn>& columns) const {
  if (!region_.region()) return;
  columns.push_back({"vmv2013.pixels", tr("Pixels"), tr("Pixels of the part that were judged"), 0,
                     BestValue::None});
  columns.push_back({"benchmark2016.pixels", tr("Pixels\n2016"),
                     tr("Those without the border of 15 px that this protocol ignores"), 0,
                     BestValue::None});
}

QStringList MetricController::provenanceOf(const EstimateEntry& entry) const {
  const Estimate& estimate = *entry.estimate;
  QStringList parameters;
  for (const auto& [key, value] : changed_parameters(estimate.method, estimate.parameters)) {
    parameters << QString::fromStdString(key + "=" + to_text(value));
  }
  return {region_.name(),
          QString::fromStdString(session_.light_field()->info().name),
          QString::fromStdString(estimate.method),
          parameters.join(' '),
          was_taken_early(estimate) ? tr("yes") : tr("no"),
          QString::fromStdString(entry.note)};
}

std::vector<Judged> MetricController::judgeAll() {
  std::vector<Judged> judged;
  std::vector<Scored> wanted;
  std::vector<const EstimateEntry*> entries;
  if (const EstimateEntry* live = session_.live()) entries.push_back(live);
  for (const EstimateEntry& entry : session_.estimates()) entries.push_back(&entry);
  for (const EstimateEntry* each_entry : entries) {
    const EstimateEntry& entry = *each_entry;
    Judged each{entry.id, entry.name, entry.estimate->seconds, {}};
    for (const Protocol protocol : kProtocols) {
      const auto evaluation =
          session_.evaluation({entry.id, judged_view(*session_.scene()), protocol});
      if (region_.region()) each.pixels[protocol] = 0;
      if (!evaluation) continue;
      tell(evaluation->notes);
      if (!region_.region()) {
        each.metrics[protocol] = evaluation->metrics;
      } else if (const PartScore* score = scoreOf(evaluation, protocol)) {
        each.metrics[protocol] = score->metrics;
        each.pixels[protocol] = score->pixels;
      } else {
        wanted.push_back({evaluation, protocol, {}});
      }
    }
    judged.push_back(std::move(each));
  }
  if (!wanted.empty()) score(std::move(wanted));
  return judged;
}

const PartScore* MetricController::scoreOf(const EvaluationPtr& evaluation,
                                           Protocol protocol) const {
  const auto found = std::ranges::find_if(scored_, [&](const Scored& each) {
    return each.evaluation == evaluation && each.protocol == protocol;
  });
  return found == scored_.end() ? nullptr : &found->score;
}

void MetricController::score(std::vector<Scored> wanted) {
  part_job_.start<std::vector<Scored>>(
      [wanted = std::move(wanted), region = region_.region()](const Progress& progress) {
        std::vector<Scored> scored = wanted;
        for (Scored& each : scored) {
          progress.check();
          each.score = score_part(*each.evaluation, region.get(), each.protocol);
        }
        return scored;
      },
      [this](const std::vector<Scored>& scored) {
        scored_.insert(scored_.end(), scored.begin(), scored.end());
        update(Part::Evaluations);
      });
}

void MetricController::tell(const std::vector<std::string>& notes) {
  for (const std::string& note : notes) {
    if (told_.insert(note).second) bench_.messages.warn(QString::fromStdString(note));
  }
}

void MetricController::save(const QString& suffix, const QString& text) {
  ask_where_to_save(&bench_.window,
                    {.name = "save_table",
                     .title = tr("Save the table"),
                     .filter = suffix == "csv" ? tr("CSV (*.csv)") : tr("LaTeX (*.tex)"),
                     .proposal = "metrics." + suffix},
                    [this, text](const QString& path) {
                      write_in_background(
                          bench_.jobs, bench_.messages, path,
                          [path, text](const Progress&) { write_text_file(path, text); });
                    });
}

}  // namespace episcope

#include "moc_metric_controller.cpp"
