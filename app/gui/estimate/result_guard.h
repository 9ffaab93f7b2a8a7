// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/gui/bench/workbench.h"

#include <QElapsedTimer>
#include <QMessageBox>
#include <QObject>
#include <QPointer>

#include <functional>
#include <vector>

namespace episcope {

struct EstimateEntry;

/// Asks before results that took long to compute, or a method that still runs, are lost because the
/// light field is left; offers to save them all.
class ResultGuard : public QObject {
  Q_OBJECT

 public:
  explicit ResultGuard(const Workbench& bench);

  /// Results that took less time are made again more quickly than the question is answered: 5 s
  /// unless set.
  void setWorthKeeping(double seconds) { worth_keeping_s_ = seconds; }

 private:
  using Continue = std::function<void()>;

  [[nodiscard]] bool mayLeave() const;
  void ask(const Continue& go_on);
  void saveAll(const Continue& go_on);
  [[nodiscard]] std::vector<EstimateEntry> unsaved() const;
  [[nodiscard]] bool isRunning() const;
  [[nodiscard]] QString sentence() const;

  Workbench bench_;
  double worth_keeping_s_ = 5;
  QElapsedTimer running_;    // since the first of the methods that run was started
  int settled_jobs_ = 0;     // that ran when the user said so:
  bool is_settled_ = false;  // what is there now may go
  QPointer<QMessageBox> question_;
};

}  // namespace episcope
