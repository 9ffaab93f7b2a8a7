// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/compare/metric_controller.h"

#include "app/gui/compare/region_controller.h"
#include "app/gui/scene/overlay.h"
#include "app/gui/shell/commands.h"
#include "app/gui/shell/dialogs.h"
#include "app/gui/shell/features.h"
#include "app/gui/shell/frame.h"
#include "app/session/command_line.h"
#include "app/session/run_estimator.h"
#include "engine/evaluation/region_metrics.h"
#include "widgets/controls/text.h"

#include <QCoreApplication>
#include <QVariant>

#include <algorithm>
#include <array>
#include <iterator>
#include <optional>

namespace episcope {
namespace {

constexpr const char* kMainMetrics[] = {"mse_100", "badpix_", "density", "shown", "layers_right"};
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

// Whether a column is left to the menu of the narrow table: it is of some pixels only, or says what
// another one, another panel, or all results say.
bool is_minor(const QString& key, bool is_whole) {
  const QString metric = key.section('.', 1);
  if (metric == "mse_100_inset15" || (metric == "density" && is_whole)) return true;
  const auto begins_as = [&metric](const char* name) { return metric.startsWith(name); };
  return key == "seconds" || (!metric.isEmpty() && std::ranges::none_of(kMainMetrics, begins_as));
}

void mark_minor(std::vector<MetricColumn>& columns, const std::vector<MetricRow>& rows) {
  for (std::size_t i = 0; i < columns.size(); ++i) {
    const bool is_whole = std::ranges::all_of(rows, [i](const MetricRow& row) {
      return !row.values[i].isValid() || row.values[i].toDouble() == 100;
    });
    columns[i].is_minor = is_minor(columns[i].key, is_whole);
  }
}

}  // namespace

/// Fills the table of metrics: every result under both protocols, in the evaluated region.
class MetricController : public QObject {
  Q_OBJECT

 public:
  MetricController(const Workbench& bench, MetricTable* table, const RegionController& region)
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
    addCommands();
    connect(&region_, &RegionController::changed, this, [this] {
      scored_.clear();
      update(Part::Evaluations);
    });
    session_.on_changed([this](Parts parts) { update(parts); });
    update(Part::Scene);
  }

 private:
  /// Score of a region in an evaluation.
  struct Scored {
    EvaluationPtr evaluation;
    Protocol protocol;
    PartScore score;
  };

  void addCommands() {
    const auto add = [this](const QString& suffix, const QString& text, const QString& tip) {
      bench_.commands.add(
          {.id = "file.save_metrics_" + suffix,
           .menu = Menu::Export,
           .text = text,
           .tip = tip,
           .run = [this,
                   suffix] { save(suffix, suffix == "csv" ? table_->toCsv() : table_->toLatex()); },
           .section = section::kResults,
           .enabled = [this] { return !table_->isEmpty(); }});
    };
    add("csv", tr("Table of metrics (CSV)…"),
        tr("Writes the metrics of all results with every column, as numbers for a program"));
    add("tex", tr("Table of metrics (LaTeX)…"),
        tr("Writes the metrics of all results as they are shown, as a LaTeX table"));
  }

  void update(Parts parts) {
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

  void fillTable() {
    const auto& scene = session_.scene();
    if (!scene || (!scene->truth->has_disparity() && !scene->truth->has_layers())) {
      table_->setTable({}, {});
      table_->setEmptyText(scene
                               ? tr("This light field has no ground truth to compare results with.")
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
    add_text("region", tr("Evaluated on"));
    add_text("scene", tr("Scene"));
    add_text("method_id", tr("Method"));
    add_text("parameters", tr("Parameters"));
    add_text("ended_early", tr("Ended early"));
    add_text("note", tr("Note"));
    std::vector<MetricRow> rows;
    for (const Judged& each : judged) {
      const EstimateEntry& entry = *session_.find_estimate(each.id);
      rows.push_back(row_of(each, places));
      rows.back().warning = foreign_text(entry);
      for (const QString& cell : provenanceOf(entry)) rows.back().values.emplace_back(cell);
    }
    mark_minor(columns, rows);
    table_->setTable(columns, rows);
  }

  void addPixels(std::vector<MetricColumn>& columns) const {
    if (!region_.region()) return;
    columns.push_back(
        {"vmv2013.pixels", tr("Pixels"), tr("Pixels that were evaluated"), 0, BestValue::None});
    columns.push_back(
        {"benchmark2016.pixels", tr("Pixels\n2016"),
         tr("Evaluated pixels without the border of 15 px that this protocol ignores"), 0,
         BestValue::None});
  }

  [[nodiscard]] QStringList provenanceOf(const EstimateEntry& entry) const {
    const Estimate& estimate = *entry.estimate;
    QStringList parameters;
    const ParameterSet changed = changed_parameters(estimate.method, estimate.parameters);
    for (const auto& [key, value] : changed) {
      parameters << QString::fromStdString(key + "=" + to_text(value));
    }
    if (estimate.range.length() > 0 && !find_value(changed, "range")) {
      parameters << "searched=" + QString::fromStdString(to_text(IntervalOrAuto(estimate.range)));
    }
    return {region_.name(),
            QString::fromStdString(session_.light_field()->info().name),
            QString::fromStdString(estimate.method),
            parameters.join(' '),
            was_taken_early(estimate) ? tr("yes") : tr("no"),
            QString::fromStdString(entry.note)};
  }

  [[nodiscard]] std::vector<Judged> judgeAll() {
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

  /// Score of the evaluated region; none while it is being computed.
  [[nodiscard]] const PartScore* scoreOf(const EvaluationPtr& evaluation, Protocol protocol) const {
    const auto found = std::ranges::find_if(scored_, [&](const Scored& each) {
      return each.evaluation == evaluation && each.protocol == protocol;
    });
    return found == scored_.end() ? nullptr : &found->score;
  }

  void score(std::vector<Scored> wanted) {
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

  /// Warns once per light field of missing metrics.
  void tell(const std::vector<std::string>& notes) {
    for (const std::string& note : notes) {
      if (!told_.insert(note).second) continue;
      bench_.messages.warn(finding_words(note));
      bench_.messages.endWithLightField();
    }
  }

  void save(const QString& suffix, const QString& text) {
    ask_where_to_save_text(bench_,
                           {.name = "save_table",
                            .title = tr("Save the table"),
                            .filter = suffix == "csv" ? tr("CSV (*.csv)") : tr("LaTeX (*.tex)"),
                            .proposal = named_after_front(bench_, "metrics." + suffix)},
                           text);
  }

  Workbench bench_;
  Session& session_;
  MetricTable* table_;
  const RegionController& region_;
  LatestJob part_job_;
  std::vector<Scored> scored_;  // of the present part
  std::set<std::string> told_;
};

namespace {

struct MetricName {
  const char* key;
  const char* label;
  const char* help;
  int decimals = 2;
};

// Meaning of a key's suffix; a key may have several.
struct PartName {
  const char* suffix;
  const char* label;
  const char* help;
};

struct MetricTableText {
  Q_DECLARE_TR_FUNCTIONS(episcope::MetricTable)

 public:
  // Metrics in the order of tables.
  static constexpr MetricName kNames[] = {
      {"mse_100", QT_TR_NOOP("MSE×100"), QT_TR_NOOP("Mean squared error ×100, px²"), 3},
      {"badpix_0070", QT_TR_NOOP("bad .07"), QT_TR_NOOP("Pixels off by more than 0.07 px, in %")},
      {"badpix_0030", QT_TR_NOOP("bad .03"), QT_TR_NOOP("Pixels off by more than 0.03 px, in %")},
      {"badpix_0010", QT_TR_NOOP("bad .01"), QT_TR_NOOP("Pixels off by more than 0.01 px, in %")},
      {"q_25_100", QT_TR_NOOP("Q25"),
       QT_TR_NOOP("Error ×100 below which the best quarter of the pixels lies, px"), 3},
      {"density", QT_TR_NOOP("dense"), QT_TR_NOOP("Pixels with a value, in %"), 1},
      {"shown", QT_TR_NOOP("shown"),
       QT_TR_NOOP("Pixels with ground truth that the light field shows, in %"), 1},
      {"mse_100_inset15", QT_TR_NOOP("MSE inner"),
       QT_TR_NOOP("Mean squared error ×100 without a border of 15 px, px²"), 3},
      {"discontinuities_0070", QT_TR_NOOP("edges"),
       QT_TR_NOOP("Pixels at depth edges off by more than 0.07 px, in %")},
      {"bumpiness_planes_100_0050", QT_TR_NOOP("bumps pl."), QT_TR_NOOP("Bumpiness of planes ×100"),
       3},
      {"bumpiness_contin_surfaces_100_0050", QT_TR_NOOP("bumps sm."),
       QT_TR_NOOP("Bumpiness of smooth surfaces ×100"), 3},
      {"mae_planes", QT_TR_NOOP("angle pl."),
       QT_TR_NOOP("Median angular error of normals on planes, °")},
      {"mae_contin_surfaces", QT_TR_NOOP("angle sm."),
       QT_TR_NOOP("Median angular error of normals on smooth surfaces, °")},
      {"fine_fattening_0150", QT_TR_NOOP("fattened"),
       QT_TR_NOOP("Pixels around fine structures that are more than 0.15 px too near, in %")},
      {"fine_thinning_0150", QT_TR_NOOP("thinned"),
       QT_TR_NOOP("Pixels of fine structures that are more than 0.15 px too far, in %")},
      {"backgammon_fattening_0070", QT_TR_NOOP("fattening"),
       QT_TR_NOOP("Pixels beside the foreground that are closer to it than to their "
                  "background, in %")},
      {"backgammon_thinning_0070", QT_TR_NOOP("thinning"),
       QT_TR_NOOP("Pixels of the foreground that are closer to the background than to it, "
                  "in %")},
      {"missed_dots_50_0400", QT_TR_NOOP("missed dots"),
       QT_TR_NOOP("Dots with at least half of their pixels off by more than 0.4 px, in %")},
      {"background_mse_100", QT_TR_NOOP("MSE backgr."),
       QT_TR_NOOP("Mean squared error ×100 of the background between dots, px²"), 3},
      {"low_texture_0070", QT_TR_NOOP("low texture"),
       QT_TR_NOOP("Pixels without much texture off by more than 0.07 px, in %")},
      {"dark_stripes_0070", QT_TR_NOOP("dark str."),
       QT_TR_NOOP("Pixels of dark stripes, of high contrast, off by more than 0.07 px, in %")},
      {"bright_stripes_0070", QT_TR_NOOP("bright str."),
       QT_TR_NOOP("Pixels of bright stripes, of low contrast, off by more than 0.07 px, in %")},
      {"bumpiness_slanted_100_0050", QT_TR_NOOP("bumps sl."),
       QT_TR_NOOP("Bumpiness of slanted surfaces ×100"), 3},
      {"bumpiness_parallel_100_0050", QT_TR_NOOP("bumps par."),
       QT_TR_NOOP("Bumpiness of surfaces parallel to the image ×100"), 3},
      {"runtime_log", QT_TR_NOOP("log time"), QT_TR_NOOP("Decadic logarithm of the seconds taken")},
      {"layers_right", QT_TR_NOOP("layers"),
       QT_TR_NOOP("Pixels with the correct number of layers, one or two, in %"), 1}};
  static constexpr PartName kParts[] = {
      {"_foreground", QT_TR_NOOP("front"), QT_TR_NOOP("Of the surface in front")},
      {"_background", QT_TR_NOOP("behind"), QT_TR_NOOP("Of the background seen through it")},
      {"_present", QT_TR_NOOP("present"),
       QT_TR_NOOP("Of the pixels that have a value; else missing values count as the farthest "
                  "true disparity")},
      {kLowResSuffix, QT_TR_NOOP("low res."),
       QT_TR_NOOP("In the resolution of the views: the official score needs the truth of ten "
                  "times the resolution")}};
};
constexpr auto& kNames = MetricTableText::kNames;
constexpr auto& kParts = MetricTableText::kParts;

// A key without its suffixes, and the indices of their meanings, the first suffix first.
struct KeyParts {
  std::string base;
  std::vector<std::size_t> parts;
};

KeyParts parts_of(const std::string& key) {
  KeyParts split{key, {}};
  for (std::size_t part = 0; part < std::size(kParts);) {
    const std::string suffix = kParts[part].suffix;
    if (!split.base.ends_with(suffix)) {
      ++part;
      continue;
    }
    split.base.resize(split.base.size() - suffix.size());
    split.parts.insert(split.parts.begin(), part);
    part = 0;
  }
  return split;
}

const MetricName* name_of(const std::string& base) {
  return std::find_if(std::begin(kNames), std::end(kNames),
                      [&](const MetricName& name) { return name.key == base; });
}

}  // namespace

int metric_rank(const std::string& key) {
  const KeyParts split = parts_of(key);
  int of_parts = 0;
  for (const std::size_t part : split.parts) of_parts |= 1 << part;
  return static_cast<int>((name_of(split.base) - std::begin(kNames)) << std::size(kParts)) +
         of_parts;
}

MetricColumn metric_column(Protocol protocol, const std::string& key) {
  const KeyParts split = parts_of(key);
  const MetricName* found = name_of(split.base);
  const bool is_known = found != std::end(kNames);
  const QString full_key = QString(protocol_name(protocol)) + '.' + QString::fromStdString(key);
  QString label = is_known ? MetricTableText::tr(found->label) : QString::fromStdString(key);
  const QString year =
      protocol == Protocol::Vmv2013 ? MetricTableText::tr("2013") : MetricTableText::tr("2016");
  const QString rules =
      protocol == Protocol::Vmv2013
          ? MetricTableText::tr("Protocol vmv2013: all pixels with ground truth, center view")
          : MetricTableText::tr(
                "Protocol benchmark2016: without a border of 15 px, center "
                "view");
  const bool is_share =
      key.starts_with("density") || key.starts_with("shown") || key == "layers_right";
  QString help = is_known ? MetricTableText::tr(found->help) : QString();
  for (const std::size_t part : split.parts) {
    if (!is_known) break;
    label += ' ' + MetricTableText::tr(kParts[part].label);
    help += '\n' + MetricTableText::tr(kParts[part].help);
  }
  return {full_key, year + '\n' + label, QStringList{help, rules, full_key}.join('\n'),
          is_known ? found->decimals : 3, is_share ? BestValue::Greatest : BestValue::Least};
}

void add_metrics(const Workbench& bench, MetricTable* table, const RegionController& region) {
  new MetricController(bench, table, region);
}

}  // namespace episcope

#include "metric_controller.moc"
