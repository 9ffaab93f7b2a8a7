// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/gui/shell/jobs.h"
#include "app/gui/shell/workbench.h"
#include "app/session/session.h"
#include "engine/evaluation/metrics.h"
#include "engine/evaluation/region_metrics.h"
#include "widgets/panels/metric_table.h"

#include <QObject>

#include <map>
#include <set>
#include <string>
#include <vector>

namespace episcope {

class RegionController;

/// A result with its known scores.
struct Judged {
  int id = 0;
  std::string name;
  double seconds = 0;
  std::map<Protocol, Metrics> metrics;
  std::map<Protocol, std::size_t> pixels{};  ///< Evaluated pixels; empty for the whole view.
};

/// Fills the table of metrics: every result under both protocols, in the evaluated region.
class MetricController : public QObject {
  Q_OBJECT

 public:
  MetricController(const Workbench& bench, MetricTable* table, const RegionController& region);

 private:
  /// Score of a region in an evaluation.
  struct Scored {
    EvaluationPtr evaluation;
    Protocol protocol;
    PartScore score;
  };

  void addCommands();
  void update(Parts parts);
  void fillTable();
  void addPixels(std::vector<MetricColumn>& columns) const;
  [[nodiscard]] QStringList provenanceOf(const EstimateEntry& entry) const;
  [[nodiscard]] std::vector<Judged> judgeAll();
  /// Score of the evaluated region; none while it is being computed.
  [[nodiscard]] const PartScore* scoreOf(const EvaluationPtr& evaluation, Protocol protocol) const;
  void score(std::vector<Scored> wanted);
  /// Warns once per light field of missing metrics.
  void tell(const std::vector<std::string>& notes);
  void save(const QString& suffix, const QString& text);

  Workbench bench_;
  Session& session_;
  MetricTable* table_;
  const RegionController& region_;
  LatestJob part_job_;
  std::vector<Scored> scored_;  // of the present part
  std::set<std::string> told_;
};

/// Header, tool tip and decimals of a metric, by its key in engine/evaluation.
[[nodiscard]] MetricColumn metric_column(Protocol protocol, const std::string& key);

/// Rank of a metric in tables: the most important first, independent of the protocol.
[[nodiscard]] int metric_rank(const std::string& key);

}  // namespace episcope
