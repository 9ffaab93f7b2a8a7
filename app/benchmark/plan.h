// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/benchmark/benchmark.h"
#include "app/benchmark/run_log.h"

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace episcope {

/// Size of a scene, on which the time of a run depends.
struct SceneSize {
  std::size_t views = 0;
  std::size_t pixels = 0;  ///< Of one view.
};

/// Processor seconds that a run is expected to take: a constant of the method (measured, see the
/// source) times the pixels of all views that it reads. Rough, and measured on one small scene, but
/// enough to bundle short runs and to begin with the long ones.
[[nodiscard]] double estimated_seconds(const BenchmarkRun& run, const SceneSize& size);

/// Seconds to open such a scene, which every task spends again.
[[nodiscard]] double opening_seconds(const SceneSize& size);

struct PlanScene {
  std::string input;  ///< What opens it.
  std::string name;   ///< As in the tables.
  /// `LoadedScene::whole_fingerprint`; empty if it could not be read, and then nothing runs on
  /// it.
  std::string fingerprint;
};

/// One run on one scene.
struct PlanPoint {
  std::size_t scene = 0;
  std::size_t run = 0;  ///< Among `planned_runs`.
  std::string key;      ///< `record_key` of its result.
};

/// What one machine does in one go.
struct PlanTask {
  double seconds = 0;  ///< Estimated.
  std::vector<PlanPoint> points;
};

/// The command line that a plan was made of.
struct PlanCommand {
  std::vector<std::string> arguments;
  std::filesystem::path folder;  ///< Where it was given, which names of files are relative to.
};

/// A benchmark divided into tasks that any number of machines can do in any order, `plan.json` in
/// its folder. Every task appends to a log of its own, `tasks/<number>.jsonl`.
struct BenchmarkPlan {
  static constexpr const char* kFileName = "plan.json";

  PlanCommand command;
  std::string request;  ///< `request_fingerprint`.
  double task_seconds = 0;
  std::vector<PlanScene> scenes;
  std::vector<PlanTask> tasks;  ///< The longest first.

  [[nodiscard]] std::size_t point_count() const;
  [[nodiscard]] double seconds() const;
};

/// 16 hexadecimal digits that change with what is asked for: inputs, runs, submissions, how inputs
/// are read (`reading`), and the program's version.
[[nodiscard]] std::string request_fingerprint(const BenchmarkOptions& options,
                                              const std::string& reading);

/// Opens every scene once and divides all runs into tasks of at least `task_seconds`, in the order
/// of the tables; a task may span scenes. Throws Cancelled.
[[nodiscard]] BenchmarkPlan make_plan(const BenchmarkOptions& options, const SceneLoader& load,
                                      double task_seconds, const Progress& progress);

/// Throws IoError, naming `--plan`, if the folder has no plan or one that cannot be read.
[[nodiscard]] BenchmarkPlan read_plan(const std::filesystem::path& folder);
[[nodiscard]] BenchmarkPlan read_plan_file(const std::filesystem::path& file);
/// The plan as JSON text, with the runs spelled out for people and other programs.
[[nodiscard]] std::string plan_to_json(const BenchmarkPlan& plan, const BenchmarkOptions& options);

/// Where task `number` of a benchmark in `folder` keeps its log.
[[nodiscard]] std::filesystem::path task_log(const std::filesystem::path& folder,
                                             std::size_t number);

/// Makes this the plan of the folder. An equal plan stays as it is. Before another one is replaced,
/// its finished runs go into the log of the benchmark. Throws IoError, also while a task of the
/// other one is running.
void install_plan(const BenchmarkPlan& plan, const BenchmarkOptions& options);

/// Cuts a sequence of runs into bundles of neighbors, each as short as possible with at least
/// `least_seconds` of work (the last may be shorter); returns the first run of each bundle. A
/// bundle is never longer than `least_seconds` plus its last run. Linear.
[[nodiscard]] std::vector<std::size_t> bundle_starts(const std::vector<double>& seconds,
                                                     double least_seconds);

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
