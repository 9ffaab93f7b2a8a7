// SPDX-License-Identifier: BSD-3-Clause
#include "app/benchmark/benchmark.h"
#include "app/benchmark/plan.h"
#include "app/benchmark/report.h"
#include "app/cli/arguments.h"
#include "app/cli/input.h"
#include "app/cli/job.h"
#include "app/cli/output.h"
#include "app/cli/parameter_options.h"
#include "app/cli/slurm.h"
#include "app/cli/verbs/verbs.h"
#include "engine/core/error.h"
#include "engine/core/text.h"
#include "engine/disparity/estimator.h"
#include "engine/disparity/registry.h"
#include "engine/io/base/atomic_file.h"
#include "engine/io/base/files.h"
#include "engine/io/base/json.h"
#include "engine/io/models/scribble_file.h"
#include "engine/labeling/labeler.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <iostream>
#include <map>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

namespace episcope::cli {
namespace {

namespace fs = std::filesystem;

/// Whether to submit to Slurm, with which options of sbatch.
struct SlurmRequest {
  bool is_wanted = false;
  std::vector<std::string> options;
};

/// What a command line of `benchmark` asks for.
struct BenchmarkRequest {
  std::vector<std::string> inputs;
  std::vector<std::string> submissions;
  ParameterOptions map;
  std::optional<std::vector<Estimator>> methods;
  bool has_labels = false;
  std::optional<std::vector<FeatureSet>> features;
  std::optional<std::vector<Regularizer>> regularizers;
  std::optional<std::string> scribbles;  ///< Folder of SCRIBBLES, each named after a scene.
  std::string output;
  bool has_search = false;
  bool is_json = false;
  ParameterOptions profile;
  JobOptions job;
  ReadOptions read;

  SlurmRequest slurm;
  std::optional<std::string> plan_file;
  std::optional<int> point;
  bool collects = false;
  bool wants_status = false;
  std::optional<double> task_seconds;

  [[nodiscard]] bool makes_plan() const { return slurm.is_wanted || plan_file; }
  /// Whether a plan that is there says what to run.
  [[nodiscard]] bool follows_plan() const { return point || collects || wants_status; }
};

constexpr int kMaxTask = 999999;
constexpr double kMaxTaskSeconds = 1e6;

template <NamedEnum E>
std::vector<E> all_values() {
  std::vector<E> values;
  for (const Named<E>& each : names_of(E{})) values.push_back(each.value);
  return values;
}

/// Several values by their names, each once.
template <NamedEnum E>
OptionValue<std::vector<E>> values_value(const char* name) {
  return {name, [name](const std::string& option, const std::string& text) {
            const OptionValue<E> known = choice_of<E>();
            std::vector<E> chosen;
            for (const std::string& each : words_value(name).read(option, text)) {
              const E value = known.read(option, each);
              if (std::ranges::find(chosen, value) == chosen.end()) chosen.push_back(value);
            }
            return chosen;
          }};
}

OptionValue<std::vector<Estimator>> methods_value() {
  return {"ID,...", [](const std::string& option, const std::string& text) {
            return text == "all" ? registered_estimators()
                                 : methods_named(words_value("ID,...").read(option, text));
          }};
}

ParameterDescription profile_description() {
  ParameterDescription profile = profile_schema().description(kProfileKey);
  profile.help =
      "Defaults of every method: tuned (the best known) or paper (as published). With --search, "
      "paper repeats the experiment of the paper";
  return profile;
}

/// `values` become defaults, with all that they mean for others. A method that lacks a key keeps
/// its own.
std::vector<ParameterDescription> with_defaults(std::vector<ParameterDescription> parameters,
                                                const ParameterSet& values) {
  parameters = described_under(std::move(parameters), values);
  for (ParameterDescription& parameter : parameters) {
    for (const auto& [key, value] : values) {
      if (key == parameter.key) parameter.default_value = value;
    }
  }
  return parameters;
}

/// Every set of features with every regularizer.
std::vector<LabelerParameters> label_ways(const BenchmarkRequest& request) {
  std::vector<LabelerParameters> ways;
  for (const FeatureSet features : request.features.value_or(all_values<FeatureSet>())) {
    for (const Regularizer regularizer : request.regularizers.value_or(all_values<Regularizer>())) {
      LabelerParameters way;
      way.features = features;
      way.regularizer = regularizer;
      ways.push_back(way);
    }
  }
  return ways;
}

void declare_what(Arguments& parser, BenchmarkRequest& request) {
  parser.optional_positionals("INPUT", request.inputs,
                              "The light fields, or folders that hold some");
  parser.required_option("-o,--output", request.output, text_value("DIR"), "Output folder");
  parser.option(
      "--methods", request.methods, methods_value(),
      "Ids of estimators, separated by commas, or all (default all; none with --labeling or "
      "--maps)");
  parser.flag("--labeling", request.has_labels,
              "Label all views from the scribbles of each scene, with every set of features and "
              "regularizer; replaces methods unless --methods is given");
  parser.option("--features", request.features, values_value<FeatureSet>("NAME,..."),
                "With --labeling: sets of features, separated by commas (default all)");
  parser.option("--regularizers", request.regularizers, values_value<Regularizer>("NAME,..."),
                "With --labeling: regularizers, separated by commas (default all)");
  parser.option("--scribble-folder", request.scribbles, text_value("DIR"),
                "With --labeling: folder of scribbles, NAME.h5 for scene NAME; they replace those "
                "next to the scene");
  request.profile.declare(parser, {profile_description()});
  parser.flag("--search", request.has_search,
              "Also search for the best parameters, of each scene and of all scenes together");
  parser.list_option("--maps", request.submissions, "DIR...",
                     "Folders with maps from other programs, named after the scenes: result files, "
                     ".h5, .mat, .npy, .npz, .pfm, .tif or .csv; without --methods they are judged "
                     "alone");
  parser.earlier_name("--labels", "--labeling");
  parser.earlier_name("--scribbles", "--scribble-folder");
  parser.earlier_name("--submission", "--maps");
  ParameterDescription views = run_schema().description("views");
  views.help = "Views to estimate for the tables; all if the method can";
  ParameterDescription device = run_schema().description("device");
  device.help = "Device to compute on; methods that cannot use it run on the CPU";
  request.job.run.declare(parser, {views, device});
  parser.flag("--json", request.is_json, "Print one JSON object instead of tables");
}

OptionValue<SlurmRequest> slurm_value() {
  return {"OPTIONS",
          [](const std::string&, const std::string& text) {
            return SlurmRequest{true, option_words(text)};
          },
          {},
          true};
}

void declare_tasks(Arguments& parser, BenchmarkRequest& request) {
  parser.heading("Many machines");
  parser.option("--slurm", request.slurm, slurm_value(),
                "Submit all unfinished tasks to Slurm as a job array, followed by a job that "
                "collects; OPTIONS for sbatch are one text");
  parser.option("--plan", request.plan_file, text_value("FILE"),
                "Only divide the work into tasks; write the plan to FILE and to the output folder");
  parser.option("--point", request.point, integer_value("I", 0, kMaxTask),
                "Run one task of the plan, counted from 0; INPUT and methods may be left out");
  parser.flag("--collect", request.collects,
              "Make the tables of all finished tasks; INPUT and methods may be left out");
  parser.flag("--status", request.wants_status,
              "Count finished, failed and missing tasks; INPUT and methods may be left out");
  parser.option("--task-seconds", request.task_seconds, real_value("SECONDS", 0, kMaxTaskSeconds),
                "With --slurm or --plan: combine runs until a task is estimated to take this long; "
                "0 = one run per task (default 60)");
  parser.exclude_each_other({"--slurm", "--plan", "--point", "--collect", "--status"});
}

/// Whether methods are run: those that are named, else all unless something else is asked for.
bool runs_methods(const BenchmarkRequest& request) {
  return request.methods || (!request.has_labels && request.submissions.empty());
}

/// What contradicts itself beyond what the parser knows.
void check(const BenchmarkRequest& request, const Arguments& parser) {
  const bool runs = runs_methods(request);
  parser.check_uses(
      {{{"--features", "--regularizers", "--scribble-folder"},
        request.has_labels,
        "without --labeling"},
       {{"--task-seconds"}, request.makes_plan(), "without --slurm or --plan"},
       {{"--search", "--profile"}, runs, "without --methods, since no method is run"}});
  if (!request.map.values().empty() && request.submissions.empty()) {
    throw UsageError("benchmark: --" + request.map.values().front().first +
                     " has no effect without --maps; add it");
  }
  if (!request.inputs.empty()) return;
  if (!request.follows_plan()) {
    throw UsageError("benchmark: INPUT is required; see episcope-cli benchmark --help");
  }
  if (request.methods || request.has_labels || request.has_search || !request.submissions.empty()) {
    throw UsageError(
        "benchmark: without INPUT the plan says what to run; leave out methods and labels, or name "
        "INPUT as well");
  }
}

/// Returns and throws as `Arguments::parse`.
bool parse_benchmark(const VerbArguments& arguments, BenchmarkRequest& request) {
  Arguments parser(
      "benchmark",
      {"Runs methods on scenes, evaluates the center view by both protocols, and writes ranked\n"
       "tables (HTML, CSV, LaTeX, JSON), pictures and maps. Finished runs are kept: the same\n"
       "command resumes where it was stopped. The exit code is 1 if anything failed; the\n"
       "tables are written anyway.",
       "episcope-cli benchmark demo:edge demo:bars --methods epi_l,epi_s -o tables --search\n"
       "  episcope-cli benchmark demo:edge demo:bars --labeling --features image -o tables\n"
       "  episcope-cli benchmark scenes --methods all --search -o tables --slurm "
       "\"--time=1:00:00\""});
  declare_what(parser, request);
  declare_tasks(parser, request);
  declare_map_options(parser, request.map);
  if (!parse_reading(parser, arguments, request.job, request.read)) return false;
  check(request, parser);
  return true;
}

/// All but the inputs.
BenchmarkOptions benchmark_options(const BenchmarkRequest& request) {
  BenchmarkOptions options;
  if (request.has_labels) options.labels = label_ways(request);
  options.methods = request.methods.value_or(runs_methods(request) ? registered_estimators()
                                                                   : std::vector<Estimator>());
  for (Estimator& method : options.methods) {
    method.parameters = with_defaults(std::move(method.parameters), request.profile.values());
  }
  options.submissions.assign(request.submissions.begin(), request.submissions.end());
  options.map_reading = map_reading(request.map);
  options.folder = request.output;
  options.views = request.job.run_options().views;
  options.device = request.job.run_options().device;
  options.has_search = request.has_search;
  return options;
}

/// A plan with what it was made of.
struct PlannedBenchmark {
  BenchmarkPlan plan;
  BenchmarkRequest request;  ///< Of the command line that made the plan.
  BenchmarkOptions options;

  [[nodiscard]] BenchmarkReport collect(Job& job) const;
};

constexpr double kTaskSeconds = 60;

std::string reading_text(const BenchmarkRequest& request) {
  return io::parameters_to_json(request.read.options.values());
}

/// Refuses to replace a file that is no plan.
void check_plan_file(const fs::path& file) {
  if (!io::is_there(file)) return;
  try {
    (void)read_plan_file(file);
  } catch (const IoError&) {
    throw IoError(file, "exists and is no plan of a benchmark; name another file");
  }
}

void print_plan(const BenchmarkPlan& plan, const BenchmarkRequest& request, const Job& job) {
  const std::string file = (fs::path(request.output) / BenchmarkPlan::kFileName).string();
  if (request.is_json) {
    print_answer(Json::object({{"plan", file},
                               {"tasks", plan.tasks.size()},
                               {"points", plan.point_count()},
                               {"seconds", plan.seconds()}}),
                 job.notes(), {file, *request.plan_file});
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
    print_answer(Json::object({{"tasks", plan.tasks.size()},
                               {"submitted", tasks.size()},
                               {"jobs", jobs.tasks},
                               {"tables_job", jobs.tables}}),
                 job.notes());
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
void take_scribbles(const BenchmarkRequest& request, Scene& scene, Job& job,
                    const Progress& progress) {
  if (!request.scribbles) return;
  const fs::path name = fs::path(scene.light_field->info().name + ".h5").filename();
  const fs::path file = fs::path(*request.scribbles) / name;
  if (io::is_there(file)) {
    scene.scribbles = io::read_scribbles(file, scene, progress);
  } else if (!scene.scribbles.empty()) {
    job.note(file.string() + " is not there; the scribbles beside the light field are used");
  }
}

/// What opens the light fields that the INPUTs of a benchmark stand for.
std::vector<std::string> benchmark_inputs(const BenchmarkRequest& request, Job& job) {
  std::vector<std::string> inputs;
  for (const SceneInput& scene :
       scene_inputs(request.inputs, request.read, Frames::One, job.progress().part(0, 0))) {
    inputs.push_back(scene.input);
  }
  return inputs;
}

/// Opens them by the reading options; warnings become notes. Borrows both.
SceneLoader scene_loader(const BenchmarkRequest& request, Job& job) {
  if (request.scribbles && !io::is_folder(*request.scribbles)) {
    throw IoError(*request.scribbles, "is not a folder; name one that holds NAME.h5 for scenes");
  }
  return [&request, &job](const std::string& input, const Progress& progress) {
    Scene scene = load_input(input, request.read, job, progress);
    take_scribbles(request, scene, job, progress.part(1, 1));
    return scene;
  };
}

/// Makes the plan, keeps it in the output folder, and writes it to a file or submits its unfinished
/// tasks to Slurm. `arguments`: of the verb, for whoever runs a task.
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
  print_plan(plan, request, job);
}

BenchmarkReport PlannedBenchmark::collect(Job& job) const {
  return collect_plan(plan, options, scene_loader(request, job), job.progress());
}

/// The plan in the output folder; the working folder becomes that of the command line that made it.
/// Throws IoError if there is none, InvalidInput if it is one of other inputs, settings, or another
/// version of the program.
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

/// Runs a task. Throws Error if one of its points fails.
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
    print_answer(
        Json::object(
            {{"task", *request.point}, {"points", report.points}, {"computed", report.computed}}),
        job.notes());
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
    print_answer(Json::object({{"tasks", count_json(status.tasks)},
                               {"points", count_json(status.points)},
                               {"unfinished", status.unfinished},
                               {"running", status.running},
                               {"failures", status.failures},
                               {"seconds_left", status.seconds_left}}),
                 job.notes());
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

/// Throws if maps were to be judged, and neither they nor methods were.
void require_judged_maps(const BenchmarkReport& report) {
  std::string problem;
  for (const BenchmarkResult& result : report.results) {
    if (result.problem.empty()) return;
    if (result.is_foreign) problem = result.entry + " on " + result.scene + ": " + result.problem;
  }
  if (!problem.empty()) throw Error("none of the maps could be judged; " + problem);
}

/// A sentence for the exit code, if anything failed.
void require_success(const BenchmarkReport& report, const std::string& folder) {
  const auto failures = report.failures();
  if (failures.empty()) return require_judged_maps(report);
  const std::string more =
      failures.size() == 1 ? "" : fmt::format(" (and {} more)", failures.size() - 1);
  std::string first = failures.front();
  if (first.ends_with('.')) first.pop_back();
  throw Error(first + more + "; the tables of the others are in " + folder);
}

/// What a benchmark writes into its folder (write_report); pictures and maps are in scenes.
std::vector<std::string> written_tables(const std::string& folder) {
  std::vector<std::string> files;
  for (const char* name : {"index.html", "log.jsonl", "results.csv", "results.json", "scenes",
                           "tables.csv", "tables.tex"}) {
    files.push_back((fs::path(folder) / name).string());
  }
  return files;
}

void print_report(const BenchmarkRequest& request, const BenchmarkReport& report, const Job& job) {
  if (request.is_json) {
    return print_answer(io::parse_json<Json>(report_to_json(report)), job.notes(),
                        written_tables(request.output));
  }
  for (const TitledTable& titled : report_tables(report)) {
    std::cout << titled.title << '\n';
    if (!titled.note.empty()) std::cout << titled.note << '\n';
    std::cout << '\n' << table_to_text(titled.table) << '\n';
  }
  std::cout << (std::filesystem::path(request.output) / "index.html").string() << ": "
            << report.results.size() << " results, " << report.searched.size()
            << " points searched, " << report.reused << " taken from before\n";
}

/// What is to be known of maps of other programs.
void note_submissions(const BenchmarkReport& report, Job& job) {
  for (const auto& result : report.results) {
    if (!result.is_foreign) continue;
    for (const std::string& note : result.notes) {
      job.note(result.entry + " on " + result.scene + ": " + note);
    }
  }
}

// What a scene does to every method is said once.
void note_problems(const BenchmarkReport& report, Job& job) {
  std::map<std::pair<std::string, std::string>, std::string> entries;  // by scene and problem
  for (const auto& result : report.results) {
    if (result.problem.empty() || result.has_failed) continue;
    std::string& names = entries[{result.scene, result.problem}];
    names += (names.empty() ? "" : ", ") + result.entry;
  }
  for (const auto& [where, names] : entries) {
    job.note(names + " on " + where.first + ": " + where.second);
  }
}

/// Throws Unavailable if runs demand a device that this machine lacks; where they are planned, it
/// may.
void require_devices(const BenchmarkOptions& options) {
  for (const Estimator& method : options.methods) {
    const bool can = std::ranges::count(method.info.devices, options.device) > 0;
    if (can) require_device(options.device, method.info);
  }
}

/// Writes what a benchmark found out, of whatever machines.
void answer(const BenchmarkRequest& request, const BenchmarkReport& report, Job& job) {
  note_problems(report, job);
  note_submissions(report, job);
  job.finish();
  require_success(report, request.output);
  print_report(request, report, job);
}

}  // namespace

void run_benchmark(const VerbArguments& arguments, std::stop_token stop) {
  BenchmarkRequest request;
  if (!parse_benchmark(arguments, request)) return;
  Job job(std::move(stop), request.job);
  if (request.makes_plan()) return plan_benchmark(arguments, request, job);
  if (request.follows_plan()) {
    const PlannedBenchmark planned = planned_benchmark(request, job);
    if (request.point) {
      require_devices(planned.options);
      return run_point(planned, request, job);
    }
    if (request.wants_status) return print_status(planned, request, job);
    return answer(request, planned.collect(job), job);
  }
  BenchmarkOptions options = benchmark_options(request);
  require_devices(options);
  options.inputs = benchmark_inputs(request, job);
  answer(request, episcope::run_benchmark(options, scene_loader(request, job), job.progress()),
         job);
}

}  // namespace episcope::cli
