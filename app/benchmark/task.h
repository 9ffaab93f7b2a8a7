// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/benchmark/plan.h"

#include <cstddef>
#include <string>
#include <vector>

namespace episcope {

/// What a task did.
struct TaskReport {
  std::size_t points = 0;
  std::size_t computed = 0;  ///< The others had been finished before.
  std::vector<std::string> failures;
};

/// Makes the unfinished runs of task `number`. Each is in the task's log as soon as it is finished,
/// so that an interruption costs one run. Scenes without such runs are not opened. Failures are
/// reported and logged, and tried again the next time.
///
/// Throws InvalidInput if there is no such task or a scene has changed since the plan was made,
/// IoError, also if a scene cannot be read or another program runs this task, Cancelled.
[[nodiscard]] TaskReport run_task(const BenchmarkPlan& plan, std::size_t number,
                                  const BenchmarkOptions& options, const SceneLoader& load,
                                  const Progress& progress);

/// Progress of the tasks of a plan.
struct PlanStatus {
  struct Count {
    std::size_t all = 0;
    std::size_t done = 0;
    std::size_t failed = 0;  ///< Tasks with a point that failed, of which none is missing; points.

    [[nodiscard]] std::size_t missing() const { return all - done - failed; }
  };
  Count tasks;
  Count points;
  std::vector<std::size_t> unfinished;  ///< Tasks that failed or are missing, in their order.
  std::vector<std::size_t> running;     ///< Tasks that hold their log now.
  std::vector<std::string> failures;    ///< Sentences, by task and point.
  double seconds_left = 0;              ///< Estimated, of the unfinished tasks.
};

/// Reads the logs; tasks may be running. Throws IoError.
[[nodiscard]] PlanStatus plan_status(const BenchmarkPlan& plan,
                                     const std::filesystem::path& folder);

/// Takes the finished runs of all tasks into the log of the benchmark and writes the tables that
/// `run_benchmark` would write; they name what failed or is missing. Opens every scene once. Throws
/// as `run_benchmark`.
[[nodiscard]] BenchmarkReport collect_plan(const BenchmarkPlan& plan, BenchmarkOptions options,
                                           const SceneLoader& load, const Progress& progress);

}  // namespace episcope
