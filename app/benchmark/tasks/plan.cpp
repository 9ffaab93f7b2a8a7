// SPDX-License-Identifier: BSD-3-Clause
#include "app/benchmark/tasks/plan.h"

#include "app/benchmark/run/open_scene.h"
#include "app/benchmark/run/planned_runs.h"
#include "app/benchmark/run/scene_fingerprint.h"
#include "app/benchmark/run/scene_runs.h"
#include "app/benchmark/tasks/bundle.h"
#include "engine/core/error.h"

#include <algorithm>
#include <numeric>
#include <set>

namespace episcope {
namespace {

/// All points of a benchmark in the order of the tables, with what each is expected to take.
struct Points {
  std::vector<PlanPoint> points;
  std::vector<double> seconds;
  std::vector<double> opening;  ///< By scene.
};

SceneSize size_of(const LightField& light_field) {
  return {static_cast<std::size_t>(light_field.grid().count()),
          static_cast<std::size_t>(light_field.width()) * light_field.height()};
}

void add_points(const BenchmarkOptions& options, const OpenScene& open,
                const std::vector<PlannedRun>& runs, std::size_t scene, Points& all) {
  const SceneSize size = size_of(*open.scene.light_field);
  const SceneRuns scene_runs(options, open);
  all.opening.back() = opening_seconds(size);
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const BenchmarkRun& run = runs[i].run;
    if (run.kind == RunKind::Search && !open.scene.truth->has_disparity()) continue;
    all.points.push_back({scene, i, scene_runs.key(run)});
    all.seconds.push_back(estimated_seconds(run, size));
  }
}

PlanTask make_task(const Points& all, std::size_t begin, std::size_t end) {
  PlanTask task;
  task.points.assign(all.points.begin() + begin, all.points.begin() + end);
  std::set<std::size_t> scenes;
  for (const PlanPoint& point : task.points) scenes.insert(point.scene);
  task.seconds = std::accumulate(all.seconds.begin() + begin, all.seconds.begin() + end, 0.0);
  for (const std::size_t scene : scenes) task.seconds += all.opening[scene];
  return task;
}

std::vector<PlanTask> make_tasks(const Points& all, double task_seconds) {
  std::vector<std::size_t> starts = bundle_starts(all.seconds, task_seconds);
  starts.push_back(all.points.size());
  std::vector<PlanTask> tasks;
  for (std::size_t i = 0; i + 1 < starts.size(); ++i) {
    tasks.push_back(make_task(all, starts[i], starts[i + 1]));
  }
  std::ranges::stable_sort(tasks, std::greater(), &PlanTask::seconds);
  return tasks;
}

}  // namespace

std::size_t BenchmarkPlan::point_count() const {
  std::size_t count = 0;
  for (const PlanTask& task : tasks) count += task.points.size();
  return count;
}

double BenchmarkPlan::seconds() const {
  double sum = 0;
  for (const PlanTask& task : tasks) sum += task.seconds;
  return sum;
}

std::string request_fingerprint(const BenchmarkOptions& options, const std::string& reading) {
  Fingerprint fingerprint;
  const auto add_text = [&fingerprint](const std::string& text) {
    fingerprint.add_value(text.size());
    fingerprint.add(text);
  };
  for (const std::string& input : options.inputs) add_text(input);
  add_text("runs");
  for (const PlannedRun& planned : planned_runs(options)) add_text(record_key(planned.run, ""));
  for (const auto& folder : options.submissions) add_text(folder.string());
  add_text(reading);
  return fingerprint.text();
}

BenchmarkPlan make_plan(const BenchmarkOptions& options, const SceneLoader& load,
                        double task_seconds, const Progress& progress) {
  BenchmarkPlan plan;
  plan.task_seconds = task_seconds;
  const std::vector<PlannedRun> runs = planned_runs(options);
  Points all;
  std::set<std::string> taken;
  const double count = static_cast<double>(options.inputs.size());
  for (const std::string& input : options.inputs) {
    const double done = static_cast<double>(plan.scenes.size());
    const Progress part = progress.part(done / count, (done + 1) / count).titled(input);
    part.check();
    all.opening.push_back(0);
    try {
      const OpenScene open = open_benchmark_scene(options, input, load, taken, part);
      plan.scenes.push_back({input, open.name, open.whole_fingerprint()});
      add_points(options, open, runs, plan.scenes.size() - 1, all);
    } catch (const Error&) {
      plan.scenes.push_back({input, input, {}});  // the tables tell why
    }
    taken.insert(plan.scenes.back().name);
  }
  plan.tasks = make_tasks(all, task_seconds);
  return plan;
}

}  // namespace episcope
