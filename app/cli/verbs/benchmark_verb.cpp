// SPDX-License-Identifier: BSD-3-Clause
#include "app/benchmark/report/report_files.h"
#include "app/benchmark/report/report_json.h"
#include "app/benchmark/run/benchmark.h"
#include "app/cli/arguments/arguments.h"
#include "app/cli/arguments/parameter_options.h"
#include "app/cli/arguments/usage_error.h"
#include "app/cli/input/scene_inputs.h"
#include "app/cli/verbs/verbs.h"
#include "engine/disparity/common/profile.h"
#include "engine/disparity/registry.h"

#include <fmt/format.h>

#include <algorithm>
#include <iostream>
#include <map>
#include <optional>
#include <sstream>

namespace episcope::cli {
namespace {

template <NamedEnum E>
std::vector<E> all_values() {
  std::vector<E> values;
  for (const Named<E>& each : names_of(E{})) values.push_back(each.value);
  return values;
}

struct Request {
  std::vector<std::string> inputs;
  std::vector<std::string> submissions;
  std::optional<std::vector<Estimator>> methods;
  bool has_labels = false;
  std::optional<std::vector<FeatureSet>> features;
  std::optional<std::vector<Regularizer>> regularizers;
  std::string output;
  bool has_search = false;
  bool is_json = false;
  ParameterOptions profile;
  JobOptions job;
  ReadOptions read;
};

/// Estimators by their ids, each once.
std::vector<Estimator> methods_named(const std::string& list) {
  const std::vector<Estimator> all = registered_estimators();
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

bool parse(const VerbArguments& arguments, Request& request) {
  Arguments parser(
      "benchmark",
      {"Runs methods on scenes, evaluates the centre view by both protocols, and writes ranked\n"
       "tables (HTML, CSV, LaTeX, JSON), pictures and maps. Finished runs are kept: the same\n"
       "command resumes where it was stopped. The exit code is 1 if anything failed; the\n"
       "tables are written nevertheless.",
       "episcope-cli benchmark demo:edge demo:bars --methods epi_l,epi_s -o tables --search\n"
       "episcope-cli benchmark demo:edge demo:bars --labels --features image -o tables"});
  parser.positionals("INPUT", request.inputs, "The light fields, or folders that hold some");
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
  request.profile.declare(parser, {profile_description()});
  parser.flag("--search", request.has_search,
              "Also search for the best parameters, of each scene and of all scenes together");
  parser.list_option("--submission", request.submissions, "DIR...",
                     "Folders with maps from other programs, named after the scenes");
  ParameterDescription views = run_schema().description("views");
  views.help = "Views to estimate for the tables; all if the method can";
  request.job.run.declare(parser, {views});
  parser.flag("--json", request.is_json, "Print one JSON object instead of tables");
  if (!parse_reading(parser, arguments, request.job, request.read)) return false;
  if (!request.has_labels && (request.features || request.regularizers)) {
    throw UsageError(
        "benchmark: --features and --regularizers have no effect without --labels; add it");
  }
  return true;
}

/// Every set of features with every regulariser.
std::vector<LabelerParameters> label_ways(const Request& request) {
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

BenchmarkOptions benchmark_options(const Request& request, const std::vector<SceneInput>& scenes) {
  BenchmarkOptions options;
  for (const SceneInput& scene : scenes) options.inputs.push_back(scene.input);
  if (request.has_labels) options.labels = label_ways(request);
  options.methods = request.methods.value_or(request.has_labels ? std::vector<Estimator>()
                                                                : registered_estimators());
  for (Estimator& method : options.methods) {
    method.parameters = with_defaults(std::move(method.parameters), request.profile.values());
  }
  options.submissions.assign(request.submissions.begin(), request.submissions.end());
  options.folder = request.output;
  options.views = request.job.run_options().views;
  options.has_search = request.has_search;
  return options;
}

/// A sentence for the exit code, if anything failed.
void require_success(const BenchmarkReport& report, const std::string& folder) {
  const auto failures = report.failures();
  if (failures.empty()) return;
  const std::string more =
      failures.size() == 1 ? "" : fmt::format(" (and {} more)", failures.size() - 1);
  std::string first = failures.front();
  if (first.ends_with('.')) first.pop_back();
  throw Error(first + more + "; the tables of the others are in " + folder);
}

void print_answer(const Request& request, const BenchmarkReport& report) {
  if (request.is_json) {
    std::cout << report_to_json(report);
    return;
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

}  // namespace

void run_benchmark(const VerbArguments& arguments, std::stop_token stop) {
  Request request;
  if (!parse(arguments, request)) return;
  Job job(std::move(stop), request.job);
  const std::vector<SceneInput> scenes =
      scene_inputs(request.inputs, request.read, Frames::One, job.progress().part(0, 0));
  const BenchmarkOptions options = benchmark_options(request, scenes);
  const SceneLoader load = [&](const std::string& input, const Progress& progress) {
    Scene scene = load_input(input, request.read, progress);
    for (const auto& warning : scene.convention.warnings) job.note(warning);
    return scene;
  };
  const BenchmarkReport report = episcope::run_benchmark(options, load, job.progress());
  note_problems(report, job);
  job.finish();
  require_success(report, request.output);
  print_answer(request, report);
}

}  // namespace episcope::cli
