// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/gui/bench/workbench.h"
#include "app/session/session.h"

#include <QObject>

#include <map>
#include <set>
#include <string>
#include <vector>

namespace episcope {

class MetricTable;

/// A result with the numbers that are known of it.
struct Judged {
  int id = 0;
  std::string name;
  double seconds = 0;
  std::map<Protocol, Metrics> metrics;
};

/// Fills the table of metrics: every result under both protocols.
class MetricController : public QObject {
  Q_OBJECT

 public:
  MetricController(const Workbench& bench, MetricTable* table);

 private:
  void update(Parts parts);
  void fillTable();
  [[nodiscard]] QStringList provenanceOf(const EstimateEntry& entry) const;
  [[nodiscard]] std::vector<Judged> judgeAll();
  /// Warns of metrics that are missing, once for each light field.
  void tell(const std::vector<std::string>& notes);
  void save(const QString& suffix, const QString& text);

  Workbench bench_;
  Session& session_;
  MetricTable* table_;
  std::set<std::string> told_;
};

}  // namespace episcope
