// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/gui/jobs.h"
#include "app/gui/panels.h"
#include "app/session/session.h"

#include <QObject>

namespace episcope {

/// Fills the table of metrics: every result under both protocols.
class MetricController : public QObject {
  Q_OBJECT

 public:
  MetricController(Session& session, Jobs& jobs, const Panels& panels, QObject* parent);

 private:
  void update(Parts parts);
  void fillTable();
  void save(const QString& suffix, const QString& text);

  Session& session_;
  Jobs& jobs_;
  Panels panels_;
};

}  // namespace episcope
