// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/gui/frame/frame.h"
#include "app/gui/frame/jobs.h"
#include "app/session/session.h"

#include <QObject>

#include <map>
#include <string>
#include <vector>

namespace episcope {

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
  MetricController(Session& session, Jobs& jobs, const Panels& panels, QObject* parent);

 signals:
  /// One sentence for the user.
  void hint(const QString& sentence);
  void written(const QString& path);

 private:
  void update(Parts parts);
  void fillTable();
  [[nodiscard]] std::vector<Judged> judgeAll();
  void save(const QString& suffix, const QString& text);

  Session& session_;
  Jobs& jobs_;
  Panels panels_;
};

}  // namespace episcope
