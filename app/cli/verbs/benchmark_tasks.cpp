// SPDX-License-Identifier: BSD-3-Clause
#include "app/cli/verbs/benchmark_tasks.h"

#include "app/benchmark/tasks/task.h"
#include "app/cli/input/scene_inputs.h"
#include "app/cli/output/json.h"
#include "engine/core/error.h"
#include "engine/core/text/join.h"
#include "engine/io/durable/atomic_file.h"
#include "engine/io/labels/scribble_file.h"
#include "engine/io/maps/parameter_json.h"

#include <fmt/format.h>

#include <algorithm>
#include <iostream>

namespace episcope::cli {
namespace {

namespace fs = std::filesystem;

constexpr double kTaskSeconds = 60;

std::string reading_text(const BenchmarkRequest& request) {
  return io::parameters_to_json(request.read.options.values());
}

/// Refuses to replace a file that is no plan.
void check_plan_file(const fs::path& file) {
  std::error_code ignored;
  if (!fs::exists(file, ignored)) return;
  try {
    (void)read_plan_file(file);
  } catch (const IoError&) {
    throw IoError(file, "exists and is no plan of a benchmark; name another file");
  }
}

void print_plan(const BenchmarkPlan& plan, const BenchmarkRequest& request) {
  const std::string file = (fs::path(request.output) / BenchmarkPlan::kFileName).string();
  if (request.is_json) {
    print_json(Json::object({{"plan", file},
                             {"tasks", plan.tasks.size()},
                             {"points", plan.point_count()},
                             {"seconds", plan.seconds()}}));
    return;
  }
  std::cout << fmt::format(
      "{}: {} task{} with {} run{}, about {:.0f} s of one processor\n"
      "each:   episcope-cli benchmark -o {} --point I     (I = 0 … {})\n"
      "tables: episcope-cli benchmark -o {} --collect\n",
      file, plan.tasks.size(), plan.tasks.size() == 1 ? "" : "s", plan.point_count(),
      plan.point_count() == 1 ? "" : "s", plan.seconds(), request.output, plan.tasks.size() - 1,
      request.output);
}

void submit_unfinished(const BenchmarkPlan& plan, const BenchmarkRequest& request, Job& job) {
  const PlanStatus status = plan_status(plan, request.output);
  std::vector<std::size_t> tasks;
  std::ranges::set_difference(status.unfinished, status.running, std::back_inserter(tasks));
  const bool on_gpus = request.job.run_options().device == Device::Cuda;
  const auto options = on_gpus ? with_gpu(request.slurm.options) : request.slurm.options;
  SubmittedJobs jobs;
  if (!tasks.empty()) jobs = submit_tasks(fs::absolute(request.output), tasks, options);
  job.finish();
  if (request.is_json) {
    print_json(Json::object({{"tasks", plan.tasks.size()},
                             {"submitted", tasks.size()},
                             {"jobs", jobs.tasks},
                             {"tables_job", jobs.tables}}));
  } else if (tasks.empty()) {
    std::cout << fmt::format("nothing to submit: {} of {} tasks are finished, {} are running\n",
                             status.tasks.done, status.tasks.all, status.running.size());
  } else {
    std::cout << fmt::format(
        "{} of {} tasks submitted as job {}; job {} then makes the tables\n"
        "progress: episcope-cli benchmark -o {} --status\n",
        tasks.size(), plan.tasks.size(), joined(jobs.tasks, ", "), jobs.tables, request.output);
  }
}

/// Strokes that were named for this scene replace those beside it.
void take_scribbles(const BenchmarkRequest& request, Scene& scene, const Progress& progress) {
  if (!request.scribbles) return;
  const fs::path name = fs::path(scene.light_field->info().name + ".h5").filename();
  const fs::path file = fs::path(*request.scribbles) / name;
  std::error_code ignored;
  if (fs::exists(file, ignored)) scene.scribbles = io::read_scribbles(file, scene, progress);
}

}  // namespace

std::vector<std::string> benchmark_inputs(const BenchmarkRequest& request, Job& job) {
  std::vector<std::string> inputs;
  for (const SceneInput& scene :
       scene_inputs(request.inputs, request.read, Frames::One, job.progress().part(0, 0))) {
    inputs.push_back(scene.input);
  }
  return inputs;
}

SceneLoader scene_loader(const BenchmarkRequest& request, Job& job) {
  std::error_code ignored;
  if (request.scribbles && !fs::is_directory(*request.scribbles, ignored)) {
    throw IoError(*request.scribbles, "is not a folder; name one that holds NAME.h5 for scenes");
  }
  return [&request, &job](const std::string& input, const Progress& progress) {
    Scene scene = load_input(input, request.read, progress);
    for (const auto& warning : scene.convention.warnings) job.note(warning);
    take_scribbles(request, scene, progress.part(1, 1));
    return scene;
  };
}

void plan_benchmark(const VerbArguments& arguments, const BenchmarkRequest& request, Job& job) {
  if (request.plan_file) check_plan_file(*request.plan_file);
  BenchmarkOptions options = benchmark_options(request);
  options.inputs = benchmark_inputs(request, job);
  check_benchmark_folder(options.folder);
  BenchmarkPlan plan = make_plan(options, scene_loader(request, job),
                                 request.task_seconds.value_or(kTaskSeconds), job.progress());
  plan.command = {arguments, fs::current_path()};
  plan.request = request_fingerprint(options, reading_text(request));
  install_plan(plan, options);
  if (request.slurm.is_wanted) return submit_unfinished(plan, request, job);
  io::write_atomically(*request.plan_file, plan_to_json(plan, options));
  job.finish();
  print_plan(plan, request);
}

BenchmarkReport PlannedBenchmark::collect(Job& job) const {
  return collect_plan(plan, options, scene_loader(request, job), job.progress());
}

PlannedBenchmark planned_benchmark(const BenchmarkRequest& request, Job& job) {
  const fs::path folder = fs::absolute(request.output);
  PlannedBenchmark planned{read_plan(folder), {}, {}};
  const bool is_named = !request.inputs.empty();
  std::vector<std::string> inputs;
  if (is_named) {
    planned.request = request;
    inputs = benchmark_inputs(request, job);
  } else {
    if (!parse_benchmark(planned.plan.command.arguments, planned.request)) {
      throw IoError(folder / BenchmarkPlan::kFileName, "holds a command line that runs nothing");
    }
    for (const PlanScene& scene : planned.plan.scenes) inputs.push_back(scene.input);
  }
  fs::current_path(planned.plan.command.folder);
  planned.options = benchmark_options(planned.request);
  planned.options.inputs = std::move(inputs);
  planned.options.folder = folder;
  if (request_fingerprint(planned.options, reading_text(planned.request)) != planned.plan.request) {
    throw InvalidInput(folder.string() + ": the plan there was made " +
                       (is_named ? "for other inputs or settings, or by" : "by") +
                       " another version of the program; make it again with --plan or --slurm, "
                       "which keeps what is still valid");
  }
  return planned;
}

void run_point(const PlannedBenchmark& planned, const BenchmarkRequest& request, Job& job) {
  const TaskReport report =
      run_task(planned.plan, static_cast<std::size_t>(*request.point), planned.options,
               scene_loader(planned.request, job), job.progress());
  job.finish();
  if (!report.failures.empty()) {
    throw Error(fmt::format("{} of {} runs of task {} failed, the first: {}",
                            report.failures.size(), report.points, *request.point,
                            report.failures.front()));
  }
  if (request.is_json) {
    print_json(Json::object(
        {{"task", *request.point}, {"points", report.points}, {"computed", report.computed}}));
    return;
  }
  std::cout << fmt::format("task {}: {} runs, {} taken from before\n", *request.point,
                           report.points, report.points - report.computed);
}

void print_status(const PlannedBenchmark& planned, const BenchmarkRequest& request, Job& job) {
  const PlanStatus status = plan_status(planned.plan, planned.options.folder);
  job.finish();
  const auto count_json = [](const PlanStatus::Count& count) {
    return Json::object({{"all", count.all},
                         {"done", count.done},
                         {"failed", count.failed},
                         {"missing", count.missing()}});
  };
  if (request.is_json) {
    print_json(Json::object({{"tasks", count_json(status.tasks)},
                             {"points", count_json(status.points)},
                             {"unfinished", status.unfinished},
                             {"running", status.running},
                             {"failures", status.failures},
                             {"seconds_left", status.seconds_left}}));
    return;
  }
  for (const auto& [name, count] :
       {std::pair{"tasks", &status.tasks}, std::pair{"runs", &status.points}}) {
    std::cout << fmt::format("{:<6} {} done, {} failed, {} missing of {}\n", name, count->done,
                             count->failed, count->missing(), count->all);
  }
  if (!status.unfinished.empty()) {
    std::cout << "tasks to run: " << ranges_text(status.unfinished) << '\n';
  }
  if (!status.running.empty()) std::cout << "running: " << ranges_text(status.running) << '\n';
  for (const std::string& failure : status.failures) std::cout << "failed: " << failure << '\n';
}

}  // namespace episcope::cli
