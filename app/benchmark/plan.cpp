// SPDX-License-Identifier: BSD-3-Clause
#include "app/benchmark/plan.h"

#include "app/benchmark/scene_runs.h"
#include "engine/core/error.h"
#include "engine/core/version.h"
#include "engine/io/base/atomic_file.h"
#include "engine/io/base/files.h"
#include "engine/io/base/json.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <numeric>
#include <optional>
#include <set>
#include <string_view>

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

void add_points(const BenchmarkOptions& options, const LoadedScene& open,
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
  for (const auto& [key, value] : io::given_options(options.map_reading)) {
    add_text(key + "=" + to_text(value));
  }
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
      const LoadedScene open = open_benchmark_scene(options, input, load, taken, part);
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

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr const char* kTasksFolder = "tasks";

Json run_json(const PlannedRun& planned) {
  return {{"kind", name_of(planned.run.kind)},
          {"method", planned.run.method},
          {"views", name_of(planned.run.views)},
          {"parameters", io::parameters_json(planned.run.parameters)}};
}

Json task_json(const PlanTask& task) {
  Json points = Json::array();
  for (const PlanPoint& point : task.points) {
    points.push_back(Json::array({point.scene, point.run, point.key}));
  }
  return {{"seconds", task.seconds}, {"points", points}};
}

PlanTask task_from(const Json& json, std::size_t scene_count) {
  PlanTask task{json.at("seconds"), {}};
  for (const Json& point : json.at("points")) {
    task.points.push_back({point.at(0), point.at(1), point.at(2)});
    if (task.points.back().scene >= scene_count) throw InvalidInput("no such scene");
  }
  return task;
}

/// Results go to folders that are named so.
std::string scene_name_of(const Json& json) {
  std::string name = json;
  if (name.empty() || name == ".." || name == "." || name != fs::path(name).filename()) {
    throw InvalidInput("the name of a scene is none of a folder");
  }
  return name;
}

BenchmarkPlan plan_from(const Json& json) {
  BenchmarkPlan plan;
  plan.command.arguments = json.at("command");
  plan.command.folder = json.at("folder").get<std::string>();
  plan.request = json.at("request");
  plan.task_seconds = json.at("task_seconds");
  for (const Json& scene : json.at("scenes")) {
    plan.scenes.push_back(
        {scene.at("input"), scene_name_of(scene.at("name")), scene.at("fingerprint")});
  }
  for (const Json& task : json.at("tasks")) {
    plan.tasks.push_back(task_from(task, plan.scenes.size()));
  }
  return plan;
}

/// Whether both have the same tasks, whatever the command line looked like.
bool is_same(const BenchmarkPlan& a, const BenchmarkPlan& b) {
  const auto fingerprints = [](const BenchmarkPlan& plan) {
    std::vector<std::string> all{plan.request};
    for (const PlanScene& scene : plan.scenes) all.push_back(scene.fingerprint);
    return all;
  };
  return a.task_seconds == b.task_seconds && fingerprints(a) == fingerprints(b);
}

std::optional<BenchmarkPlan> plan_in(const fs::path& folder) {
  if (!io::is_there(folder / BenchmarkPlan::kFileName)) return std::nullopt;
  return read_plan_file(folder / BenchmarkPlan::kFileName);
}

/// Takes what tasks finished into the log of the benchmark.
void retire(const BenchmarkPlan& plan, const fs::path& folder) {
  RunRecords finished(folder);
  for (std::size_t i = 0; i < plan.tasks.size(); ++i) {
    if (io::is_held(task_log(folder, i))) {
      throw IoError(folder, "task " + std::to_string(i) +
                                " of another plan is being run; wait until it has finished, end "
                                "it, or name another folder");
    }
    finished.read(task_log(folder, i));
  }
  RunLog(folder).take_over(finished.last_of_each());
  fs::remove_all(folder / kTasksFolder);
}

}  // namespace

BenchmarkPlan read_plan(const fs::path& folder) {
  if (auto plan = plan_in(folder)) return std::move(*plan);
  throw IoError(folder, "there is no plan of a benchmark; make one with --plan or --slurm");
}

BenchmarkPlan read_plan_file(const fs::path& file) {
  try {
    return plan_from(io::read_json<Json>(file));
  } catch (const std::exception&) {
    throw IoError(file, "is no plan of a benchmark; make it again with --plan or --slurm");
  }
}

std::string plan_to_json(const BenchmarkPlan& plan, const BenchmarkOptions& options) {
  Json json{{"program", "episcope"},
            {"version", kVersion},
            {"command", plan.command.arguments},
            {"folder", plan.command.folder.string()},
            {"request", plan.request},
            {"task_seconds", plan.task_seconds}};
  json["scenes"] = Json::array();
  for (const PlanScene& scene : plan.scenes) {
    json["scenes"].push_back(
        {{"input", scene.input}, {"name", scene.name}, {"fingerprint", scene.fingerprint}});
  }
  json["runs"] = Json::array();
  for (const PlannedRun& planned : planned_runs(options)) json["runs"].push_back(run_json(planned));
  json["tasks"] = Json::array();
  for (const PlanTask& task : plan.tasks) json["tasks"].push_back(task_json(task));
  return io::json_text(json, 1) + "\n";
}

fs::path task_log(const fs::path& folder, std::size_t number) {
  return folder / kTasksFolder / (std::to_string(number) + ".jsonl");
}

void install_plan(const BenchmarkPlan& plan, const BenchmarkOptions& options) {
  const fs::path& folder = options.folder;
  check_benchmark_folder(folder);
  const std::optional<BenchmarkPlan> old = plan_in(folder);
  if (old && is_same(*old, plan)) return;
  io::make_folder(folder);
  if (old) retire(*old, folder);
  RunLog log(folder);  // says that the folder is a benchmark's
  io::make_folder(folder / kTasksFolder);
  io::write_atomically(folder / BenchmarkPlan::kFileName, plan_to_json(plan, options));
}

std::vector<std::size_t> bundle_starts(const std::vector<double>& seconds, double least_seconds) {
  std::vector<std::size_t> starts;
  double sum = 0;
  for (std::size_t i = 0; i < seconds.size(); ++i) {
    if (starts.empty() || sum >= least_seconds) {
      starts.push_back(i);
      sum = 0;
    }
    sum += seconds[i];
  }
  return starts;
}

namespace {

/// Nanoseconds of processor time for each sample position of all views, with default parameters,
/// measured on demo:edge (9×9×128×128).
struct MethodCost {
  std::string_view id;
  double all_views = 0;
  double center = 0;
};

constexpr std::array kCosts{
    MethodCost{"epi_l", 130, 120},      MethodCost{"epi_s", 360, 150},
    MethodCost{"epi_c", 800, 800},      MethodCost{"epi_g", 150, 150},
    MethodCost{"st_av_l", 190, 190},    MethodCost{"st_av_s", 250, 250},
    MethodCost{"st_av_g", 550, 550},    MethodCost{"st_ch_l", 150, 150},
    MethodCost{"st_ch_s", 160, 160},    MethodCost{"st_ch_g", 230, 230},
    MethodCost{"kz02", 2200, 2200},     MethodCost{"epi_two_layer", 1550, 170},
    MethodCost{"plane_pm", 5700, 2300}, MethodCost{"net", 1900, 900},
};

constexpr MethodCost kLabeling{"", 5000, 5000};
constexpr MethodCost kOther{"", 2000, 2000};
constexpr double kOpeningCost = 30;
constexpr double kLeastSeconds = 0.01;

MethodCost cost_of(const BenchmarkRun& run) {
  if (run.kind == RunKind::Labels) return kLabeling;
  for (const MethodCost& cost : kCosts) {
    if (cost.id == run.method) return cost;
  }
  return kOther;
}

}  // namespace

double estimated_seconds(const BenchmarkRun& run, const SceneSize& size) {
  const MethodCost cost = cost_of(run);
  const double each = run.views == ViewSelection::All ? cost.all_views : cost.center;
  return kLeastSeconds + 1e-9 * each * static_cast<double>(size.views * size.pixels);
}

double opening_seconds(const SceneSize& size) {
  return kLeastSeconds + 1e-9 * kOpeningCost * static_cast<double>(size.views * size.pixels);
}

namespace {

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
