// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/gui/frame/frame.h"
#include "app/gui/frame/jobs.h"
#include "app/session/run/run_estimator.h"
#include "app/session/session.h"

#include <QObject>

#include <optional>

namespace episcope {

struct RunRequest;

/// Runs methods in the background and lists what they found.
class EstimateController : public QObject {
  Q_OBJECT

 public:
  EstimateController(Session& session, Jobs& jobs, const Panels& panels, QObject* parent);

  /// Runs what the form says; parameters are copied now.
  void run();
  void run(const EstimateRequest& request);
  /// Cancels every run.
  void cancel();
  void removeShown();
  /// The line for what the form says.
  void copyCommand();
  void showNeighbour(int step);

 signals:
  void exportRequested(int estimate);
  void hint(const QString& sentence);

 private:
  void update(Parts parts);
  void showRunning();
  void listResults();
  void copyCommandOf(const EstimateEntry& entry);
  void copy(const std::string& command);
  void reuse(const EstimateEntry& entry);

  Session& session_;
  Jobs& jobs_;
  Panels panels_;
};

}  // namespace episcope
