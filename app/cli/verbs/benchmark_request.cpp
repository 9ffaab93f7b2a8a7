// SPDX-License-Identifier: BSD-3-Clause
#include "app/cli/verbs/benchmark_request.h"

#include "app/cli/arguments/arguments.h"
#include "app/cli/arguments/usage_error.h"
#include "engine/disparity/common/profile.h"
#include "engine/disparity/registry.h"

#include <algorithm>
#include <sstream>

namespace episcope::cli {
namespace {

constexpr int kMaxTask = 999999;
constexpr double kMaxTaskSeconds = 1e6;

template <NamedEnum E>
std::vector<E> all_values() {
  std::vector<E> values;
  for (const Named<E>& each : names_of(E{})) values.push_back(each.value);
  return values;
}

/// Estimators by their ids, each once.
std::vector<Estimator> methods_named(const std::string& list) {
  const std::vector<Estimator>& all = registered_estimators();
  if (list == "all") return all;
  std::vector<std::string> ids;
  for (const Estimator& each : all) ids.push_back(each.info.id);
  std::vector<Estimator> chosen;
  std::istringstream names(list);
  for (std::string name; std::getline(names, name, ',');) {
    const auto known = std::find(ids.begin(), ids.end(), name);
    if (known == ids.end()) throw unknown_name("method", name, ids);
    const auto is_same = [&](const Estimator& each) { return each.info.id == name; };
    if (std::none_of(chosen.begin(), chosen.end(), is_same)) {
      chosen.push_back(all[known - ids.begin()]);
    }
  }
  if (chosen.empty()) throw UsageError("--methods is empty; name ids of methods, or all");
  return chosen;
}

/// Several values by their names, each once.
template <NamedEnum E>
OptionValue<std::vector<E>> values_value(const char* name) {
  return {name, [](const std::string&, const std::string& text) {
            std::vector<E> chosen;
            std::istringstream names(text);
            for (std::string each; std::getline(names, each, ',');) {
              const std::vector<std::string> known = all_names<E>();
              if (std::ranges::find(known, each) == known.end()) {
                throw unknown_name("choice", each, known);
              }
              const E value = value_named<E>(each);
              if (std::ranges::find(chosen, value) == chosen.end()) chosen.push_back(value);
            }
            return chosen;
          }};
}

OptionValue<std::vector<Estimator>> methods_value() {
  return {"ID,...",
          [](const std::string&, const std::string& text) { return methods_named(text); }};
}

ParameterDescription profile_description() {
  ParameterDescription profile = profile_schema().description(kProfileKey);
  profile.help =
      "Defaults of every method: tuned, the best known; paper, the method as published. With "
      "--search, paper is the experiment of the paper";
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

/// Every set of features with every regulariser.
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
  parser.option("--methods", request.methods, methods_value(),
                "Ids of estimators, separated by commas, or all");
  parser.flag("--labels", request.has_labels,
              "Label all views from the strokes of each scene, by every set of features and "
              "regulariser; instead of methods, unless --methods is given");
  parser.option("--features", request.features, values_value<FeatureSet>("NAME,..."),
                "With --labels: sets of features, separated by commas (default all)");
  parser.option("--regularizers", request.regularizers, values_value<Regularizer>("NAME,..."),
                "With --labels: regularisers, separated by commas (default all)");
  parser.option(
      "--scribbles", request.scribbles, text_value("DIR"),
      "With --labels: folder of scribbles, NAME.h5 for the scene NAME, which replace those "
      "next to it");
  request.profile.declare(parser, {profile_description()});
  parser.flag("--search", request.has_search,
              "Also search for the best parameters, of each scene and of all scenes together");
  parser.list_option("--submission", request.submissions, "DIR...",
                     "Folders with maps from other programs, named after the scenes");
  ParameterDescription views = run_schema().description("views");
  views.help = "Views to estimate for the tables; all if the method can";
  ParameterDescription device = run_schema().description("device");
  device.help = "Device to compute on; methods that cannot stay on the CPU";
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
                "Submit all tasks that are not finished as a job array to Slurm, and a job that "
                "then collects; OPTIONS are those of sbatch, as one text");
  parser.option(
      "--plan", request.plan_file, text_value("FILE"),
      "Only divide the work into tasks, and write the plan to FILE and the output folder");
  parser.option("--point", request.point, integer_value("I", 0, kMaxTask),
                "Run one task of the plan, from 0 on; INPUT and methods may be left out");
  parser.flag("--collect", request.collects,
              "Make the tables of what the tasks have finished; likewise");
  parser.flag("--status", request.wants_status,
              "Count finished, failed and missing tasks; likewise");
  parser.option("--task-seconds", request.task_seconds, real_value("SECONDS", 0, kMaxTaskSeconds),
                "With --slurm or --plan: put runs together until a task is estimated to take so "
                "long; 0: each run is a task (default 60)");
  parser.exclude_each_other({"--slurm", "--plan", "--point", "--collect", "--status"});
}

/// What contradicts itself beyond what the parser knows.
void check(const BenchmarkRequest& request) {
  if (!request.has_labels && (request.features || request.regularizers || request.scribbles)) {
    throw UsageError(
        "benchmark: --features, --regularizers and --scribbles have no effect without --labels; "
        "add it");
  }
  if (request.task_seconds && !request.makes_plan()) {
    throw UsageError("benchmark: --task-seconds has no effect without --slurm or --plan; add one");
  }
  if (!request.inputs.empty()) return;
  if (!request.follows_plan()) {
    throw UsageError("benchmark: INPUT is required; see episcope-cli benchmark --help");
  }
  if (request.methods || request.has_labels || request.has_search || !request.submissions.empty()) {
    throw UsageError(
        "benchmark: without INPUT all is taken from the plan; leave out what to run, or name INPUT "
        "as well");
  }
}

}  // namespace

bool parse_benchmark(const VerbArguments& arguments, BenchmarkRequest& request) {
  Arguments parser(
      "benchmark",
      {"Runs methods on scenes, evaluates the centre view by both protocols, and writes ranked\n"
       "tables (HTML, CSV, LaTeX, JSON), pictures and maps. Finished runs are kept: the same\n"
       "command resumes where it was stopped. The exit code is 1 if anything failed; the\n"
       "tables are written nevertheless.",
       "episcope-cli benchmark demo:edge demo:bars --methods epi_l,epi_s -o tables --search\n"
       "episcope-cli benchmark demo:edge demo:bars --labels --features image -o tables\n"
       "episcope-cli benchmark scenes --methods all --search -o tables --slurm "
       "\"--time=1:00:00\""});
  declare_what(parser, request);
  declare_tasks(parser, request);
  parser.heading("Options");
  if (!parse_reading(parser, arguments, request.job, request.read)) return false;
  check(request);
  return true;
}

BenchmarkOptions benchmark_options(const BenchmarkRequest& request) {
  BenchmarkOptions options;
  if (request.has_labels) options.labels = label_ways(request);
  options.methods = request.methods.value_or(request.has_labels ? std::vector<Estimator>()
                                                                : registered_estimators());
  for (Estimator& method : options.methods) {
    method.parameters = with_defaults(std::move(method.parameters), request.profile.values());
  }
  options.submissions.assign(request.submissions.begin(), request.submissions.end());
  options.folder = request.output;
  options.views = request.job.run_options().views;
  options.device = request.job.run_options().device;
  options.has_search = request.has_search;
  return options;
}

}  // namespace episcope::cli
