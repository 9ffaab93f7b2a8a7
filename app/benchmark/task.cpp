// SPDX-License-Identifier: BSD-3-Clause
#include "app/benchmark/task.h"

#include "app/benchmark/benchmark.h"
#include "app/benchmark/run_log.h"
#include "app/benchmark/scene_runs.h"
#include "engine/core/error.h"
#include "engine/io/base/append_log.h"
#include "engine/io/base/files.h"

#include <fmt/format.h>

#include <optional>

namespace episcope {
namespace {

namespace fs = std::filesystem;

std::string failure_line(const BenchmarkResult& result) {
  return result.entry + " on " + result.scene + ": " + result.problem;
}

/// Opens the scenes of a task one after the other, and runs its points on them.
class TaskRunner {
 public:
  TaskRunner(const BenchmarkPlan& plan, const BenchmarkOptions& options, const SceneLoader& load,
             const Progress& progress)
      : plan_(plan),
        options_(options),
        load_(load),
        runs_(planned_runs(options)),
        workload_(progress) {}

  TaskReport run(std::size_t number) {
    RunLog log(options_.folder, task_log(options_.folder, number));
    const std::vector<PlanPoint> left = unfinished(number, log);
    for (std::size_t i = 0; i < left.size(); ++i) workload_.expect(1);
    TaskReport report{plan_.tasks[number].points.size(), left.size(), {}};
    for (const PlanPoint& point : left) {
      const BenchmarkRecord record = run_point(point);
      log.add(record);
      if (record.result.has_failed) report.failures.push_back(failure_line(record.result));
    }
    return report;
  }

 private:
  [[nodiscard]] std::vector<PlanPoint> unfinished(std::size_t number, const RunLog& log) const {
    RunRecords before(options_.folder);
    before.read(options_.folder / RunLog::kFileName);
    std::vector<PlanPoint> left;
    for (const PlanPoint& point : plan_.tasks[number].points) {
      const std::string& scene = plan_.scenes[point.scene].name;
      if (!log.find(point.key, scene) && !before.find(point.key, scene)) left.push_back(point);
    }
    return left;
  }

  BenchmarkRecord run_point(const PlanPoint& point) {
    const PlanScene& scene = plan_.scenes[point.scene];
    const PlannedRun& planned = runs_.at(point.run);
    const Progress part = workload_.next(scene.name + ", " + planned.run.method);
    part.check();
    if (!open_ || point.scene != scene_) open_scene(point.scene, part);
    return scene_runs_->make(planned, part);
  }

  void open_scene(std::size_t index, const Progress& part) {
    const PlanScene& scene = plan_.scenes[index];
    scene_runs_.reset();
    open_.reset();  // one scene is in memory at a time
    open_ = open_benchmark_scene(options_, scene.input, load_, {}, part.part(0, 0));
    open_->name = scene.name;
    require_unchanged(*open_, scene.fingerprint);
    scene_ = index;
    io::make_folder(options_.folder / "scenes" / scene.name);
    scene_runs_.emplace(options_, *open_);
  }

  const BenchmarkPlan& plan_;
  const BenchmarkOptions& options_;
  const SceneLoader& load_;
  std::vector<PlannedRun> runs_;
  Workload workload_;
  std::size_t scene_ = 0;  ///< That is open.
  std::optional<LoadedScene> open_;
  std::optional<SceneRuns> scene_runs_;
};

/// What the log of the benchmark and those of its tasks hold.
struct KnownRuns {
  RunRecords before;
  RunRecords tasks;

  [[nodiscard]] bool has(const PlanPoint& point, const std::string& scene) const {
    return tasks.find(point.key, scene) || before.find(point.key, scene);
  }
  /// Null if it did not fail.
  [[nodiscard]] const BenchmarkRecord* failure(const PlanPoint& point,
                                               const std::string& scene) const {
    for (const RunRecords* records : {&tasks, &before}) {
      const BenchmarkRecord* last = records->last(point.key, scene);
      if (last && last->result.has_failed) return last;
    }
    return nullptr;
  }
};

void count_task(const BenchmarkPlan& plan, std::size_t number, const KnownRuns& known,
                PlanStatus& status) {
  std::size_t done = 0, failed = 0;
  const PlanTask& task = plan.tasks[number];
  for (const PlanPoint& point : task.points) {
    const std::string& scene = plan.scenes[point.scene].name;
    if (known.has(point, scene)) {
      ++done;
    } else if (const BenchmarkRecord* failure = known.failure(point, scene)) {
      status.failures.push_back(failure_line(failure->result));
      ++failed;
    }
  }
  status.points.all += task.points.size();
  status.points.done += done;
  status.points.failed += failed;
  ++status.tasks.all;
  if (done == task.points.size()) {
    ++status.tasks.done;
    return;
  }
  status.tasks.failed += done + failed == task.points.size();
  status.unfinished.push_back(number);
  status.seconds_left += task.seconds;
}

}  // namespace

TaskReport run_task(const BenchmarkPlan& plan, std::size_t number, const BenchmarkOptions& options,
                    const SceneLoader& load, const Progress& progress) {
  if (number >= plan.tasks.size()) {
    throw InvalidInput(fmt::format("the plan in {} has {} tasks, from 0 on, but no task {}",
                                   options.folder.string(), plan.tasks.size(), number));
  }
  return TaskRunner(plan, options, load, progress).run(number);
}

PlanStatus plan_status(const BenchmarkPlan& plan, const fs::path& folder) {
  KnownRuns known{RunRecords(folder), RunRecords(folder)};
  known.before.read(folder / RunLog::kFileName);
  for (std::size_t i = 0; i < plan.tasks.size(); ++i) known.tasks.read(task_log(folder, i));
  PlanStatus status;
  for (std::size_t i = 0; i < plan.tasks.size(); ++i) {
    count_task(plan, i, known, status);
    if (io::is_held(task_log(folder, i))) status.running.push_back(i);
  }
  return status;
}

BenchmarkReport collect_plan(const BenchmarkPlan& plan, BenchmarkOptions options,
                             const SceneLoader& load, const Progress& progress) {
  RunRecords finished(options.folder);
  for (std::size_t i = 0; i < plan.tasks.size(); ++i) finished.read(task_log(options.folder, i));
  RunLog(options.folder).take_over(finished.last_of_each());
  options.inputs.clear();
  options.recorded.emplace();
  for (const PlanScene& scene : plan.scenes) {
    options.inputs.push_back(scene.input);
    options.recorded->push_back(scene.fingerprint);
  }
  return run_benchmark(options, load, progress);
}

}  // namespace episcope
