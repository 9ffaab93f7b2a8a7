// SPDX-License-Identifier: BSD-3-Clause
#include "app/cli/arguments.h"
#include "app/cli/input.h"
#include "app/cli/job.h"
#include "app/cli/output.h"
#include "app/cli/parameter_options.h"
#include "app/cli/streams.h"
#include "app/cli/verbs/verbs.h"
#include "app/session/result_files.h"
#include "app/session/run_estimator.h"
#include "app/session/scene_summary.h"
#include "engine/core/memory.h"
#include "engine/core/text.h"
#include "engine/disparity/registry.h"
#include "engine/io/base/files.h"
#include "engine/io/base/json.h"
#include "engine/io/models/external_result.h"
#include "engine/io/models/result_file.h"
#include "engine/io/open.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <filesystem>
#include <iomanip>
#include <iostream>
#include <optional>

namespace episcope::cli {
namespace {

namespace fs = std::filesystem;

struct EstimateArguments {
  std::string method;
  const Estimator* estimator = nullptr;  ///< That of `method`, once all is parsed.
  ParameterOptions parameters;
  std::vector<std::string> inputs;
  std::string output;
  Frames frames = Frames::One;
  bool is_submission = false;
  Overwrite overwrite = Overwrite::No;
  bool is_json = false;
  io::Hdf5Storage floats = io::Hdf5Storage::Plain;  ///< Of a result file.
  std::size_t memory = 0;                           ///< 0: two thirds of what is free.
  JobOptions job;
  ReadOptions read;
};

/// The method must be known before its options can be: the first argument that names one.
const Estimator* method_among(const VerbArguments& arguments) {
  for (const auto& argument : arguments) {
    if (const Estimator* estimator = known_estimator(argument)) return estimator;
  }
  return nullptr;
}

/// Without a known method its options cannot be judged: says so first.
void require_method(const VerbArguments& arguments) {
  if (std::any_of(arguments.begin(), arguments.end(), asks_for_help)) return;
  const auto name = std::find_if(arguments.begin(), arguments.end(),
                                 [](const std::string& each) { return !each.starts_with("-"); });
  if (name == arguments.end()) return;
  throw unknown_name("method", *name, estimator_ids());
}

/// With the parameters of `estimator` among the options, if it is known.
bool parse_as(const Estimator* estimator, const VerbArguments& arguments,
              EstimateArguments& request) {
  Arguments parser(
      "estimate",
      {"Estimates disparity and writes a result file. METHOD is an id listed by\n"
       "'episcope-cli methods'; 'episcope-cli estimate METHOD --help' lists its parameters.\n"
       "OUT.npy, OUT.npz, OUT.mat, OUT.pfm, OUT.tiff and OUT.csv hold the map of the center view,\n"
       "the first three of all with --views all. Several light fields, or those in\n"
       "a folder, get a result file each in the folder DIR, named after light field and method\n"
       "(cotton_epi_l.h5); one that fails does not stop the others. A result of another method,\n"
       "other parameters or another light field is replaced only with --overwrite.",
       "episcope-cli estimate epi_l demo -o demo.h5 --views center\n"
       "  episcope-cli estimate epi_l demo:edge demo:bars -o results\n"
       "  episcope-cli estimate plane_pm benchmark2016 -o ours --submission"});
  parser.positional("METHOD", request.method, "Id of the estimator, in any case");
  parser.positionals("INPUT", request.inputs,
                     "The light field, or several; - is one on standard input: HDF5, .npy, .npz, "
                     ".mat or TIFF");
  parser.required_option(
      "-o,--output", request.output, text_value("OUT.h5|DIR"),
      "Result file to write, or a map: .npy, .npz, .mat, .pfm, .tiff, .csv; - is "
      "standard output as .npy, pfm:- as .pfm; for several light fields, a folder");
  parser.flag("--overwrite", request.overwrite, Overwrite::Yes,
              "Replace a result of another method, other parameters or another light field");
  parser.flag("--frames", request.frames, Frames::All,
              "Estimate all frames of a sequence, one result file each");
  parser.flag("--compress", request.floats, io::Hdf5Storage::Deflated,
              "Compress disparity and confidence of a result file: a third less, written at about "
              "25 MB a second; masks always are");
  parser.flag("--submission", request.is_submission,
              "Write a submission to the 2016 benchmark: DIR/disp_maps, DIR/runtimes");
  const Schema<RunOptions> run = run_schema();
  request.job.run.declare(parser, {run.description("views"), run.description("device")});
  parser.option("--memory", request.memory, bytes_value("SIZE"),
                "Memory for program, light field and method together, such as 4G; by default two "
                "thirds of what is free. Within it, epi_l, epi_s, epi_c, epi_two_layer, the local "
                "and denoised stereo methods, plane_pm and net write their maps block by block to "
                "OUT.h5.partial, and the same command continues an interrupted run; other methods "
                "run at once and put on disk what does not fit");
  parser.flag("--json", request.is_json, "Print one JSON object instead of a line");
  declare_job_options(parser, request.job);
  declare_read_options(parser, request.read);
  if (estimator) {
    parser.heading("Parameters of " + estimator->info.id);
    request.parameters.declare(parser, estimator->parameters);
  }
  if (!parser.parse(arguments)) return false;
  check_read_options(request.read);
  return true;
}

bool parse(const VerbArguments& arguments, EstimateArguments& request) {
  const Estimator* first = method_among(arguments);
  if (!first) require_method(arguments);
  if (!parse_as(first, arguments, request)) return false;
  request.estimator = known_estimator(request.method);
  if (request.estimator && request.estimator == first) return true;
  // Another argument, like the name of the output, is an id as well.
  if (!request.estimator) require_method({request.method});
  const Estimator* named = request.estimator;
  request = {};
  request.estimator = named;
  return parse_as(named, arguments, request);
}

/// The form of an output that holds maps alone; empty for a result file and for a folder.
std::optional<MapForm> map_form(const std::string& output) {
  const auto form = map_form_of(output);
  const bool is_map = form && form != MapForm::Result && form != MapForm::PointCloud;
  return is_map ? form : std::nullopt;
}

/// A name for a map of which no ground truth is read.
std::string computed_name(const fs::path& output, const std::string& method) {
  return output.stem().string() + "_estimate_" + method + output.extension().string();
}

/// Views that the method can estimate; what it cannot is wrong usage.
ViewSelection views_of_method(const EstimateArguments& request,
                              std::optional<ViewSelection> wanted) {
  try {
    return views_to_estimate(*request.estimator, wanted);
  } catch (const InvalidInput& error) {
    throw UsageError(error.what());
  }
}

ViewSelection selected_views(const EstimateArguments& request) {
  std::optional<ViewSelection> wanted;
  if (request.job.run.is_given("views")) wanted = request.job.run_options().views;
  const auto form = map_form(request.output);
  if (!request.is_submission && !form) return views_of_method(request, wanted);
  if (wanted.value_or(ViewSelection::Center) == ViewSelection::Center) return ViewSelection::Center;
  if (request.is_submission) {
    throw UsageError("a submission holds center views; leave out --views");
  }
  if (holds_all_views(*form)) return views_of_method(request, wanted);
  throw UsageError(request.output +
                   " holds the map of one view; leave out --views, or name it OUT.h5 or OUT.npy");
}

/// For JSON "all", "center" or row and column of the only view; in words for people.
struct CoveredViews {
  std::string name;
  std::string text;
};
CoveredViews covered_views(const MapGeometry& maps, ViewIndex center) {
  if (maps.grid.count() > 1) return {name_of(ViewSelection::All), "all views"};
  if (maps.first == center) return {name_of(ViewSelection::Center), "the center view"};
  return {view_text(maps.first), "view " + view_text(maps.first)};
}

/// What is estimated of one light field, and where it goes.
struct Task {
  std::string input;
  std::string output;
  std::string name{};  ///< Of the light field, if it is one of several.
  std::optional<int> frame{};
};

struct Answer {
  std::string output;
  Provenance provenance;
  MapGeometry maps;
  ViewIndex center;
  std::string runtime_file{};  ///< Of a submission.
};

void print_line(const Answer& answer) {
  const Provenance& estimate = answer.provenance;
  std::cout << answer.output << ": " << estimate.method << " of "
            << covered_views(answer.maps, answer.center).text << std::fixed << std::setprecision(2)
            << " in " << estimate.seconds << " s, searched " << estimate.range.min << " … "
            << estimate.range.max << " px, " << std::setprecision(0) << peak_memory_mib()
            << " MiB at most\n";
  if (!answer.runtime_file.empty()) {
    std::cout << answer.runtime_file << ": its seconds\n";
  }
}

Json answer_json(const Answer& answer) {
  const Provenance& estimate = answer.provenance;
  Json json;
  json["method"] = estimate.method;
  json["views"] = covered_views(answer.maps, answer.center).name;
  json["seconds"] = estimate.seconds;
  json["peak_mib"] = peak_memory_mib();
  json["parameters"] = io::parameters_json(estimate.parameters);
  json["range"] = interval_json(estimate.range);
  if (!estimate.notes.empty()) {
    json["notes"] = estimate.notes;
    json["findings"] = findings_json(estimate.notes);
  }
  json["output"] = answer.output;
  json["written"] = Json::array({answer.output});
  if (!answer.runtime_file.empty()) json["written"].push_back(answer.runtime_file);
  return json;
}

/// What the program itself leaves of a budget for light field and method, but half of it at least:
/// a small budget should not end where the program begins.
std::size_t budget_after_program(std::size_t budget) {
  return std::max(budget - std::min(used_memory(), budget), budget / 2);
}

/// Does what the command line asks for, light field by light field.
class Runner {
 public:
  Runner(const EstimateArguments& request, const InputStream& from, std::stop_token stop)
      : request_(request),
        from_(from),
        options_(request.job.run_options()),
        job_(std::move(stop), request.job) {
    options_.views = selected_views(request);
    options_.threads = job_.progress().threads();
    // The method asks as well, but not before the light field is loaded.
    require_device(options_.device, request.estimator->info);
    if (request.memory > 0) set_memory_budget(budget_after_program(request.memory));
  }

  [[nodiscard]] Job& job() { return job_; }
  /// An INPUT as it was typed.
  [[nodiscard]] std::string shown(const std::string& input) const { return from_.shown(input); }
  /// Scenes of the submission so far.
  [[nodiscard]] const std::vector<io::SubmittedScene>& submitted() const { return submitted_; }

  /// Refuses an output that cannot be written, before hours are spent. Throws UsageError, IoError.
  void check(const Task& task) const {
    if (!request_.is_submission) check_output_file(task.output);
    if (request_.is_submission || map_form(task.output)) {
      if (request_.overwrite == Overwrite::Yes) protect_light_field(task.output);
      if (request_.overwrite == Overwrite::No && holds_something(task.output)) {
        throw IoError(task.output, std::string("exists and does not tell which method made it; "
                                               "choose another name, or ") +
                                       kByOption);
      }
    } else if (map_form_of(task.output) != MapForm::Result) {
      throw UsageError("estimate writes a result file, .h5, or a map, but the output is " +
                       task.output + "; name it OUT.h5, OUT.npy or OUT.pfm");
    } else {
      check_made_output(task.output,
                        {.method = request_.estimator->info.id,
                         .parameters = request_.parameters.values(),
                         .input = from_.shown(task.input),
                         .reading = io::given_options(options_of(task)),
                         .is_of_one_view = options_.views == ViewSelection::Center},
                        request_.overwrite);
    }
    if (from_.is(task.input)) require_no_other_source(task.output, request_.overwrite);
    protect_input(task.output, task.input);
  }

  [[nodiscard]] Answer run(const Task& task, const Progress& progress) {
    const Scene scene = load(task, progress.part(0, 0.3));
    const EstimateRequest run{request_.estimator->info.id, request_.parameters.values(), options_};
    const bool is_file = !request_.is_submission && !map_form(task.output);
    const bool in_blocks =
        is_file && should_run_in_blocks(*scene.light_field, *request_.estimator, options_);
    if (request_.floats == io::Hdf5Storage::Deflated && in_blocks) {
      note(task, "a result that is written block by block is not compressed");
    }
    if (request_.memory > 0 && is_file && !in_blocks) {
      note(task, run.method +
                     " runs at once: what does not fit is put on disk, and an interrupted "
                     "run begins again");
    }
    if (map_form(task.output) && io::reads_as_truth(task.output, task.input)) {
      note(task, task.output + " will be read as ground truth of " + from_.shown(task.input) +
                     ", by its name and place; call it " + computed_name(task.output, run.method));
    }
    Answer answer = in_blocks ? run_blocks(task, run, *scene.light_field, progress.part(0.3, 1))
                              : run_at_once(task, run, scene, progress.part(0.3, 1));
    for (const auto& sentence : answer.provenance.notes) note(task, sentence);
    return answer;
  }

 private:
  /// What opens the light field again; nothing of one that came from standard input.
  [[nodiscard]] std::string source_of(const Task& task) const {
    return from_.is(task.input) ? std::string() : task.input;
  }

  [[nodiscard]] io::OpenOptions options_of(const Task& task) const {
    io::OpenOptions open = io::open_schema().parse(request_.read.options.values());
    open.frame = task.frame.value_or(open.frame);
    return open;
  }

  /// The light field alone: truth and labels of all views would double the memory that is held.
  [[nodiscard]] Scene load(const Task& task, const Progress& progress) {
    Scene scene = load_input(task.input, options_of(task), false, progress);
    for (const auto& warning : scene.convention.warnings) note(task, warning);
    for (const auto& warning : order_warnings(scene.convention)) note(task, warning);
    Scene bare;
    bare.light_field = std::move(scene.light_field);
    bare.truth = std::make_shared<const GroundTruth>();
    return bare;
  }

  [[nodiscard]] Answer run_blocks(const Task& task, const EstimateRequest& run,
                                  const LightField& light_field, const Progress& progress) {
    const std::size_t held = light_field.is_on_disk() ? 0 : light_field.byte_size();
    const auto left_of = [&](std::size_t budget) { return budget - std::min(held, budget); };
    const std::size_t wanted = memory_budget();
    const BlockRequest request{run,
                               task.output,
                               source_of(task),
                               {left_of(wanted), left_of(std::max(wanted, request_.memory))}};
    FinishedBlocks made = run_in_blocks(light_field, *request_.estimator, request, progress);
    if (!made.remark.empty()) note(task, made.remark);
    return {task.output, std::move(made.provenance), made.maps, light_field.center()};
  }

  [[nodiscard]] Answer run_at_once(const Task& task, const EstimateRequest& run, const Scene& scene,
                                   const Progress& progress) {
    const ViewIndex center = scene.light_field->center();
    const EstimatePtr estimate =
        run_estimator(scene, *request_.estimator, run.parameters, options_, progress.part(0, 0.85))
            .estimate;
    progress.step("writing " + task.output);
    check(task);  // another program may have written it meanwhile
    if (request_.is_submission) {
      submit(task, *estimate, center);
    } else if (map_form(task.output)) {
      save_maps(task.output, *estimate);
    } else {
      io::write_result(task.output, *estimate, progress.part(0.85, 1),
                       {source_text(source_of(task), task.output), request_.floats});
    }
    return {task.output, estimate->provenance(), geometry_of(estimate->field.disparity), center,
            request_.is_submission ? io::submitted_runtime_file(request_.output, task.name).string()
                                   : std::string()};
  }

  void submit(const Task& task, const Estimate& estimate, ViewIndex center) {
    if (!estimate.contains(center)) {
      throw InvalidInput("a submission holds center views, but view " +
                         view_text(estimate.field.disparity.first()) + " was estimated");
    }
    const DisparityView map = estimate.field.view(center);
    const std::size_t gaps =
        io::write_submitted_scene(request_.output, task.name, map, estimate.seconds);
    submitted_.push_back({task.name, map.disparity.height, map.disparity.width});
    if (gaps > 0) note(task, std::to_string(gaps) + " pixels without a value were filled");
  }

  /// Which of several light fields it is about must be said.
  void note(const Task& task, const std::string& sentence) {
    job_.note(task.name.empty() ? sentence : task.name + ": " + sentence);
  }

  const EstimateArguments& request_;
  const InputStream& from_;
  RunOptions options_;
  Job job_;
  std::vector<io::SubmittedScene> submitted_;
};

void estimate_one(const EstimateArguments& request, Runner& runner, const OutputStream& to) {
  const Task task{request.inputs.front(), request.output};
  runner.check(task);
  const Answer answer = runner.run(task, runner.job().progress());
  runner.job().finish();
  if (to.is_meant()) return to.send();
  if (request.is_json) {
    print_answer(answer_json(answer), runner.job().notes());
  } else {
    print_line(answer);
  }
}

/// Reads what was submitted back, and says which scenes of the benchmark it lacks.
void check_submitted(const EstimateArguments& request, Runner& runner, Failures& failures) {
  for (const auto& problem : io::submission_problems(request.output, runner.submitted())) {
    failures.add(problem);
  }
  std::vector<std::string> missing;
  for (const io::SubmittedScene& scene : io::benchmark_scenes()) {
    if (!std::filesystem::exists(io::submitted_map_file(request.output, scene.name))) {
      missing.push_back(scene.name);
    }
  }
  if (missing.empty()) return;
  runner.job().note("the benchmark also wants " + joined(missing, ", ") +
                    "; 'episcope-cli validate " + request.output + "' checks all");
}

void estimate_many(const EstimateArguments& request, const std::vector<SceneInput>& scenes,
                   Runner& runner) {
  io::make_folder(request.output);
  const auto estimate = [&](const SceneInput& scene, const Progress& progress) {
    const auto output = request.is_submission
                            ? io::submitted_map_file(request.output, scene.name)
                            : std::filesystem::path(request.output) /
                                  (scene.name + "_" + request.estimator->info.id + ".h5");
    const Task task{scene.input, output.string(), scene.name, scene.frame};
    runner.check(task);
    const Answer answer = runner.run(task, progress);
    Json json = answer_json(answer);
    json["input"] = scene.input;
    runner.job().finish();
    if (!request.is_json) print_line(answer);
    return json;
  };
  ManyAnswers answers = answers_of_many(scenes, runner.job(), estimate);
  for (Json& each : answers.results) each["input"] = runner.shown(each["input"]);
  if (request.is_submission) check_submitted(request, runner, answers.failures);
  answers.finish(runner.job(), request.is_json);
}

/// Whether the output is a folder for one result file of each light field.
bool wants_many(const EstimateArguments& request, const Progress& progress) {
  const std::string suffix = suffix_of(request.output);
  if (request.is_submission) return true;
  const bool names_file = suffix == ".h5" || suffix == ".hdf5" || map_form(request.output);
  if (request.inputs.size() == 1 && request.frames == Frames::One) {
    return !names_file && is_collection(request.inputs.front(), request.read, progress);
  }
  if (!names_file) return true;
  throw UsageError("several light fields do not go into one result file, " + request.output +
                   "; name a folder with -o DIR");
}

void check_compression(const EstimateArguments& request) {
  const bool is_asked_for = request.floats == io::Hdf5Storage::Deflated;
  if (!is_asked_for || (!request.is_submission && !map_form(request.output))) return;
  throw UsageError("--compress is for a result file; leave it out, or name the output OUT.h5");
}

}  // namespace

void run_estimate(const VerbArguments& arguments, std::stop_token stop) {
  EstimateArguments request;
  if (!parse(arguments, request)) return;
  const OutputStream to(request.output, ".npy");
  to.require_alone(request.is_json);
  check_compression(request);
  const InputStream from(request.inputs, stop);
  from.require_light_field();
  Runner runner(request, from, std::move(stop));
  if (!wants_many(request, runner.job().progress())) return estimate_one(request, runner, to);
  const std::vector<SceneInput> scenes = scene_inputs_and_failed(
      request.inputs, request.read, request.frames, runner.job().progress().part(0, 0));
  estimate_many(request, scenes, runner);
}

}  // namespace episcope::cli
