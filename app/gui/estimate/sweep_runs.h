// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/gui/shell/workbench.h"
#include "app/session/sweep.h"

#include <QObject>

#include <cstdint>
#include <vector>

namespace episcope {

/// Runs sweeps in the background, one at a time and one light field after the other, loading those
/// that are only on disk. Adds points to SceneSwitcher::sweeps.
class SweepRuns : public QObject {
  Q_OBJECT

 public:
  explicit SweepRuns(const Workbench& bench);

  /// Begins a sweep over these points (`sweep_points`) and returns its id. Precondition: none runs,
  /// and its scenes are open.
  std::uint64_t run(Sweep sweep, const std::vector<ParameterSet>& points);
  [[nodiscard]] bool isRunning() const { return job_ != 0; }
  /// 0 if none runs.
  [[nodiscard]] quint64 job() const { return job_; }
  /// The running sweep, else the last one.
  [[nodiscard]] std::uint64_t sweep() const { return sweep_; }

 signals:
  void ended(quint64 sweep);

 private:
  Workbench bench_;
  quint64 job_ = 0;  // 0 = none runs
  std::uint64_t sweep_ = 0;
};

}  // namespace episcope
