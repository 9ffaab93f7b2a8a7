// SPDX-License-Identifier: BSD-3-Clause
#include "app/benchmark/run/planned_runs.h"
#include "app/benchmark/run/run_log.h"
#include "app/benchmark/tasks/plan.h"
#include "engine/core/error.h"
#include "engine/core/version.h"
#include "engine/io/durable/append_log.h"
#include "engine/io/durable/atomic_file.h"
#include "engine/io/durable/make_folder.h"
#include "engine/io/json/bounded_json.h"
#include "engine/io/maps/parameter_json.h"

#include <nlohmann/json.hpp>

#include <optional>

namespace episcope {
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
  std::error_code ignored;
  if (!fs::exists(folder / BenchmarkPlan::kFileName, ignored)) return std::nullopt;
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
  return json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
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

}  // namespace episcope
