// SPDX-License-Identifier: BSD-3-Clause
#include "app/cli/arguments/arguments.h"
#include "app/cli/arguments/parameter_options.h"
#include "app/cli/arguments/usage_error.h"
#include "app/cli/input/input.h"
#include "app/cli/output/json.h"
#include "app/cli/output/output_file.h"
#include "app/cli/verbs/verbs.h"
#include "app/session/run/run_estimator.h"
#include "app/session/save/save_result.h"
#include "engine/disparity/registry.h"

#include <algorithm>
#include <iomanip>
#include <iostream>

namespace episcope::cli {
namespace {

struct Request {
  std::string method;
  const Estimator* estimator = nullptr;  ///< That of `method`, once all is parsed.
  ParameterOptions parameters;
  std::string input;
  std::string output;
  bool is_json = false;
  JobOptions job;
  ReadOptions read;
};

const Estimator* find(const std::vector<Estimator>& estimators, const std::string& id) {
  const auto found = std::find_if(estimators.begin(), estimators.end(),
                                  [&](const Estimator& each) { return each.info.id == id; });
  return found == estimators.end() ? nullptr : &*found;
}

/// The method must be known before its options can be: the first argument that names one.
const Estimator* method_among(const VerbArguments& arguments,
                              const std::vector<Estimator>& estimators) {
  for (const auto& argument : arguments) {
    if (const Estimator* estimator = find(estimators, argument)) return estimator;
  }
  return nullptr;
}

/// Without a known method its options cannot be judged: says so first.
void require_method(const VerbArguments& arguments, const std::vector<Estimator>& estimators) {
  const auto asks_for_help = [](const std::string& each) {
    return each == "-h" || each == "--help";
  };
  if (std::any_of(arguments.begin(), arguments.end(), asks_for_help)) return;
  const auto name = std::find_if(arguments.begin(), arguments.end(),
                                 [](const std::string& each) { return !each.starts_with("-"); });
  if (name == arguments.end()) return;
  std::vector<std::string> ids;
  for (const auto& estimator : estimators) ids.push_back(estimator.info.id);
  throw unknown_name("method", *name, ids);
}

/// With the parameters of `estimator` among the options, if it is known.
bool parse_as(const Estimator* estimator, const VerbArguments& arguments, Request& request) {
  Arguments parser("estimate",
                   {"Estimates disparity and writes a result file. METHOD is an id listed by\n"
                    "'episcope-cli methods'; 'episcope-cli estimate METHOD --help' lists its "
                    "parameters.",
                    "episcope-cli estimate epi_l demo -o demo.h5 --views center"});
  parser.positional("METHOD", request.method, "Id of the estimator");
  parser.positional("INPUT", request.input, "The light field");
  parser.required_option("-o,--output", request.output, text_value("OUT.h5"),
                         "Result file to write");
  const Schema<RunOptions> run = run_schema();
  request.job.run.declare(parser, {run.description("views"), run.description("device")});
  parser.flag("--json", request.is_json, "Print one JSON object instead of a line");
  declare_job_options(parser, request.job);
  declare_read_options(parser, request.read);
  if (estimator) {
    parser.heading("Parameters of " + estimator->info.id);
    request.parameters.declare(parser, estimator->parameters);
  }
  return parser.parse(arguments);
}

bool parse(const VerbArguments& arguments, const std::vector<Estimator>& estimators,
           Request& request) {
  const Estimator* first = method_among(arguments, estimators);
  if (!first) require_method(arguments, estimators);
  if (!parse_as(first, arguments, request)) return false;
  request.estimator = find(estimators, request.method);
  if (request.estimator && request.estimator == first) return true;
  // Another argument, like the name of the output, is an id as well.
  if (!request.estimator) require_method({request.method}, estimators);
  const Estimator* named = request.estimator;
  request = {};
  request.estimator = named;
  return parse_as(named, arguments, request);
}

ViewSelection selected_views(const Request& request) {
  const Estimator& estimator = *request.estimator;
  const bool can_all = estimator.info.all_views;
  if (!request.job.run.is_given("views")) {
    return can_all ? ViewSelection::All : ViewSelection::Center;
  }
  const ViewSelection wanted = request.job.run_options().views;
  if (can_all || wanted == ViewSelection::Center) return wanted;
  const auto& parameters = estimator.parameters;
  const bool chooses = std::any_of(parameters.begin(), parameters.end(),
                                   [](const auto& one) { return one.key == "view"; });
  throw InvalidInput(estimator.info.id + " estimates one view at a time; use --views center" +
                     (chooses ? ", or --view V,U for another" : ""));
}

/// The light field alone: truth and labels of all views would double the memory that is held.
LightFieldPtr load_light_field(const Request& request, Job& job) {
  ReadOptions read = request.read;
  read.needs_truth = false;
  const Scene scene = load_input(request.input, read, job.progress().part(0, 0.3));
  for (const auto& warning : scene.convention.warnings) job.note(warning);
  return scene.light_field;
}

/// For JSON "all", "center" or row and column of the only view; in words for people.
struct CoveredViews {
  std::string name;
  std::string text;
};
CoveredViews covered_views(const Estimate& estimate, ViewIndex center) {
  const ViewStack<float>& stack = estimate.field.disparity;
  if (stack.grid().count() > 1) return {name_of(ViewSelection::All), "all views"};
  if (stack.first() == center) return {name_of(ViewSelection::Center), "the centre view"};
  return {view_text(stack.first()), "view " + view_text(stack.first())};
}

void print_answer(const Request& request, const Estimate& estimate, ViewIndex center) {
  const CoveredViews views = covered_views(estimate, center);
  if (!request.is_json) {
    std::cout << request.output << ": " << estimate.method << " of " << views.text << std::fixed
              << std::setprecision(2) << " in " << estimate.seconds << " s, disparity "
              << estimate.range.min << " … " << estimate.range.max << " px, "
              << std::setprecision(0) << peak_memory_mib() << " MiB at most\n";
    return;
  }
  Json json;
  json["method"] = estimate.method;
  json["views"] = views.name;
  json["seconds"] = estimate.seconds;
  json["peak_mib"] = peak_memory_mib();
  json["parameters"] = parameters_json(estimate.parameters);
  json["range"] = interval_json(estimate.range);
  if (!estimate.notes.empty()) json["notes"] = estimate.notes;
  json["output"] = request.output;
  print_json(json);
}

}  // namespace

void run_estimate(const VerbArguments& arguments, std::stop_token stop) {
  const std::vector<Estimator> estimators = registered_estimators();
  Request request;
  if (!parse(arguments, estimators, request)) return;
  const Estimator& estimator = *request.estimator;
  RunOptions options = request.job.run_options();
  options.views = selected_views(request);
  // The method asks as well, but not before the light field is loaded.
  require_device(options.device, estimator.info);
  check_hdf5_output("estimate", request.output);
  check_result_output(request.output);
  protect_input(request.output, request.input);

  Job job(std::move(stop), request.job);
  const Progress& progress = job.progress();
  options.threads = progress.threads();
  const LightFieldPtr light_field = load_light_field(request, job);
  const EstimateRequest run{estimator.info.id, request.parameters.values(), options};
  const EstimatePtr estimate =
      run_estimator(*light_field, estimator, run, progress.part(0.3, 0.9)).estimate;
  progress.step("writing " + request.output);
  save_result(request.output, *estimate, request.input, progress.part(0.9, 1));
  for (const auto& note : estimate->notes) job.note(note);
  job.finish();
  print_answer(request, *estimate, light_field->center());
}

}  // namespace episcope::cli
