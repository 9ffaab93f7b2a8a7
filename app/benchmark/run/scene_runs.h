// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/benchmark/run/label_runs.h"
#include "app/benchmark/run/open_scene.h"
#include "app/benchmark/run/planned_runs.h"

#include <string>
#include <vector>

namespace episcope {

/// Makes the runs of a benchmark on one scene; borrows both.
class SceneRuns {
 public:
  SceneRuns(const BenchmarkOptions& options, const OpenScene& open);

  /// Names the result of a run on this scene (`record_key`).
  [[nodiscard]] std::string key(const BenchmarkRun& run) const;

  /// Runs, judges and, unless it is a point of a search, writes map and pictures. What fails is the
  /// problem of the result. Throws Cancelled.
  [[nodiscard]] BenchmarkRecord make(const PlannedRun& planned, const Progress& progress);

  /// Judges the centre view by both protocols and writes its pictures, which are returned. Throws
  /// IoError, Cancelled.
  std::vector<std::string> judge_and_write(const EstimatePtr& center, BenchmarkResult& result,
                                           const Progress& progress) const;

 private:
  void run_and_judge(const Estimator& method, const Progress& progress, BenchmarkRecord& record);

  const BenchmarkOptions& options_;
  const OpenScene& open_;
  LabelRuns labels_;
};

}  // namespace episcope
