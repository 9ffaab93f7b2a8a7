// SPDX-License-Identifier: BSD-3-Clause
#include "app/cli/arguments.h"
#include "app/cli/input.h"
#include "app/cli/output.h"
#include "app/cli/streams.h"
#include "app/cli/verbs/verbs.h"
#include "app/session/picture.h"
#include "app/session/result_files.h"
#include "app/session/result_fit.h"
#include "app/session/user_folders.h"
#include "engine/core/error.h"
#include "engine/core/text.h"
#include "engine/core/text_table.h"
#include "engine/io/base/files.h"
#include "engine/io/base/image_file.h"
#include "engine/io/models/external_result.h"
#include "engine/io/models/reader.h"
#include "engine/io/models/result_file.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace episcope::cli {
namespace {

namespace fs = std::filesystem;

/// A result and the light field whose truth it is judged against.
struct JudgedFile {
  std::string result;
  std::string truth;
  bool is_own = false;  ///< The result itself names that light field; its samples must be the same.
  std::string problem{};  ///< Why this one of several cannot be judged, if that is known.
};

bool is_submission(const fs::path& path) {
  return io::is_folder(io::submitted_map_file(path, "").parent_path());
}

/// A damaged file counts: judging it says what is wrong.
bool may_be_result(const fs::path& path) {
  try {
    return names_result(path.string());
  } catch (const IoError&) {
    return true;
  }
}

/// Results in and below a folder, by name.
std::vector<std::string> results_below(const fs::path& folder) {
  std::vector<std::string> found;
  constexpr auto options = fs::directory_options::skip_permission_denied;
  std::error_code ignored;
  for (const auto& entry : fs::recursive_directory_iterator(folder, options, ignored)) {
    const bool is_hidden = entry.path().filename().string().starts_with('.');
    if (is_hidden || !entry.is_regular_file() || !map_form_of(entry.path())) continue;
    if (may_be_result(entry.path())) found.push_back(entry.path().string());
  }
  std::ranges::sort(found);
  if (found.empty()) throw IoError(folder, "there is no result in this folder; name another");
  return found;
}

std::vector<std::string> expanded(const std::vector<std::string>& results) {
  std::vector<std::string> files;
  for (const std::string& one : results) {
    if (io::is_folder(one) && !is_submission(one)) {
      std::ranges::move(results_below(one), std::back_inserter(files));
    } else {
      files.push_back(one);
    }
  }
  return files;
}

/// The light field that a result names; empty for a damaged file, since judging it says what is
/// wrong.
std::string known_source_of(const std::string& result) {
  try {
    return stated_source(result);
  } catch (const IoError&) {
    return {};
  }
}

JudgedFile by_own_source(const std::string& result) {
  if (!io::is_there(result)) {
    throw IoError(result, "there is no such file or folder; check the path");
  }
  const std::string source = stated_source(result);
  const std::string input = existing_source(source, result);
  if (input.empty()) fail_without_source(result, source);
  return {result, input, true};
}

/// One of several, which does not stop the others.
JudgedFile by_own_source_of_several(const std::string& result) {
  try {
    return by_own_source(result);
  } catch (const IoError& error) {
    return {.result = result, .truth = {}, .problem = error.what()};
  }
}

/// How many letters of its name a result shares with a scene: all of that, followed by an end or a
/// further word ("cotton" of cotton_epi_l.h5); 0 for another one.
std::size_t shared_letters(const fs::path& result, const std::string& scene) {
  const std::string name = lower_case(result.stem().string());
  const std::string wanted = lower_case(scene);
  if (lower_case(result.parent_path().filename().string()) == wanted) return wanted.size();
  if (!name.starts_with(wanted)) return 0;
  const bool ends = name.size() == wanted.size() || name[wanted.size()] == '_' ||
                    name[wanted.size()] == '-' || name[wanted.size()] == '.';
  return ends ? wanted.size() : 0;
}

const SceneInput* scene_of(const std::string& result, const std::vector<SceneInput>& scenes) {
  const std::string source = existing_source(known_source_of(result), result);
  for (const SceneInput& scene : scenes) {
    if (!source.empty() && is_same_input(source, scene.input)) return &scene;
  }
  const auto letters = [&result](const SceneInput& scene) {
    return shared_letters(result, scene.name);
  };
  const auto best = std::ranges::max_element(scenes, {}, letters);
  return best != scenes.end() && letters(*best) > 0 ? &*best : nullptr;
}

std::vector<JudgedFile> matched(const std::vector<std::string>& results,
                                const std::vector<SceneInput>& scenes, Job& job) {
  std::vector<JudgedFile> files;
  std::vector<bool> is_used(results.size(), false);
  for (const SceneInput& scene : scenes) {
    for (std::size_t i = 0; i < results.size(); ++i) {
      const std::string& result = results[i];
      const bool is_of_scene =
          is_submission(result)
              ? fs::exists(io::submitted_map_file(result, io::scene_name(scene.input)))
              : scene_of(result, scenes) == &scene;
      if (!is_of_scene) continue;
      files.push_back({result, scene.input});
      is_used[i] = true;
    }
  }
  for (std::size_t i = 0; i < results.size(); ++i) {
    if (!is_used[i]) job.note(results[i] + ": no light field has its name; it is left out");
  }
  return files;
}

/// What `results` and `truth` of a command line stand for, light field by light field. A folder of
/// results stands for those below it. Without `truth`, a result is judged against the light field
/// that it names. If `truth` is a folder of light fields, each result belongs to the one that it
/// names, else to the one whose name its own begins with or its folder has; a submission to the
/// 2016 benchmark to each that it has a map of. Results of none are noted and left out.
/// Throws UsageError for a result that does not name its light field, IoError for a single one that
/// is damaged or whose light field is gone, or if nothing is left; Cancelled.
std::vector<JudgedFile> judged_files(const std::vector<std::string>& results,
                                     const std::string& truth, const ReadOptions& options,
                                     Job& job) {
  const std::vector<std::string> files = expanded(results);
  std::vector<JudgedFile> judged;
  if (truth.empty()) {
    if (files.size() == 1) return {by_own_source(files.front())};
    std::ranges::transform(files, std::back_inserter(judged), by_own_source_of_several);
    std::ranges::stable_sort(judged, {}, &JudgedFile::truth);
    return judged;
  }
  check_input(truth);
  const Progress progress = job.progress().part(0, 0);
  if (is_collection(truth, options, progress)) {
    judged = matched(files, scene_inputs({truth}, options, Frames::One, progress), job);
    if (judged.empty()) {
      throw IoError(truth,
                    "no light field in this folder has the name of a result; name one that "
                    "has");
    }
    return judged;
  }
  for (const std::string& file : files) judged.push_back({file, truth});
  return judged;
}

/// What the answer is written as.
enum class Format { Text, Json, Csv, Latex };

struct EvaluateRequest {
  std::vector<std::string> files;
  std::string truth;
  Protocol protocol = Protocol::Vmv2013;
  InvalidEstimates invalid = InvalidEstimates::Bad;
  std::optional<ViewIndex> view;
  std::vector<std::string> metrics;  ///< Empty = all.
  std::string error_map;
  Overwrite overwrite = Overwrite::No;
  Format format = Format::Text;
  ParameterOptions map;
  JobOptions job;
  ReadOptions read;
};

/// Answers in JSON, a result each.
struct JudgedResults {
  std::vector<Json> rows;
  std::vector<Json> failed;       ///< Of several: "file", "truth" if it is known, "error".
  std::vector<std::string> keys;  ///< Of their metrics, in the order of their first appearance.
};

void declare_judging(Arguments& parser, EvaluateRequest& request) {
  parser.option("--view", request.view, view_value(),
                "Camera row and column of the view that is judged; by default the center, or the "
                "first with truth");
  parser.option("--metrics", request.metrics, words_value("KEY,..."),
                "Metrics to tell, in this order, such as mse_100,density; by default all");
  parser.option("--protocol", request.protocol, choice_of<Protocol>(),
                "Metrics of the 2013 paper or of the 2016 benchmark (default vmv2013)");
  parser.option("--invalid", request.invalid, choice_of<InvalidEstimates>(),
                "Missing values (NaN): bad counts them as the farthest true disparity and as bad "
                "pixels; compatible as good pixels that means leave out, as the 2016 tool does "
                "(default bad)");
}

bool parse(const VerbArguments& arguments, EvaluateRequest& request) {
  Arguments parser(
      "evaluate",
      {"Compares results with the ground truth of their light fields: of the one that --truth\n"
       "names, of those in the folder that it names (by what a result says itself, else by name:\n"
       "cotton_epi_l.h5 or cotton/result.npy belongs to cotton), or without it of the one that a\n"
       "result file was estimated from, if its samples are still the same.",
       "episcope-cli evaluate demo.h5\n"
       "  episcope-cli evaluate demo.h5 --truth demo --protocol benchmark2016 --error-map "
       "error.png\n"
       "  episcope-cli evaluate results/ --truth scenes/ --metrics mse_100,density --csv"});
  parser.positionals(
      "RESULT", request.files,
      std::string("Result files, maps of other programs (") + io::kMapForms +
          "), or folders of them; also submissions of 2016; - is a map on standard input");
  parser.option(
      "--truth", request.truth, text_value("INPUT"),
      "The light field with its ground truth, or a folder of such; by default the one that "
      "a result names");
  declare_judging(parser, request);
  parser.flag("--json", request.format, Format::Json, "Print one JSON object");
  parser.flag("--csv", request.format, Format::Csv, "Print comma-separated values");
  parser.flag("--latex", request.format, Format::Latex, "Print a LaTeX tabular");
  parser.exclude_each_other({"--json", "--csv", "--latex"});
  parser.option("--error-map", request.error_map, text_value("OUT.png"),
                "Write a picture of truth − estimate; OUT-<result>.png of several results");
  parser.flag("--overwrite", request.overwrite, Overwrite::Yes, "Replace another error map");
  declare_map_options(parser, request.map);
  if (!parse_reading(parser, arguments, request.job, request.read)) return false;
  if (!request.error_map.empty() && suffix_of(request.error_map) != ".png") {
    throw UsageError("evaluate writes error maps as PNG, but the output is " + request.error_map +
                     "; name it OUT.png");
  }
  parser.check_uses({{{"--overwrite"}, !request.error_map.empty(), "without --error-map"}});
  return true;
}

/// OUT.png for one result; OUT-<result>.png for several, numbered where names repeat. Empty paths
/// if no error map is wanted.
std::vector<std::filesystem::path> error_map_paths(const EvaluateRequest& request,
                                                   const std::vector<JudgedFile>& files) {
  const std::filesystem::path path = request.error_map;
  if (path.empty()) return std::vector<std::filesystem::path>(files.size());
  if (files.size() == 1) return {path};
  std::vector<std::filesystem::path> paths;
  std::set<std::string> taken;
  for (const JudgedFile& file : files) {
    const std::filesystem::path result = std::filesystem::path(file.result).lexically_normal();
    const std::string stem =
        (result.has_filename() ? result.stem() : result.parent_path().stem()).string();
    const std::string name =
        unique_name(path.stem().string() + "-" + stem, "-",
                    [&](const std::string& each) { return taken.contains(each); });
    taken.insert(name);
    paths.push_back(path.parent_path() / (name + path.extension().string()));
  }
  return paths;
}

/// What pixels without a value count as.
const char* missing_rule(InvalidEstimates invalid) {
  return invalid == InvalidEstimates::Bad ? "the farthest true disparity, and bad"
                                          : "good, and left out of means";
}

Json results_json(const EvaluateRequest& request, const JudgedResults& judged) {
  Json json;
  json["protocol"] = protocol_name(request.protocol);
  if (!request.truth.empty()) json["truth"] = request.truth;
  if (!judged.rows.empty()) {
    if (request.truth.empty()) json["truth"] = judged.rows.front()["truth"];
    json["view"] = judged.rows.front()["view"];
  }
  json["missing_values"] = missing_rule(request.invalid);
  json["results"] = judged.rows;
  for (const Json& each : judged.failed) json["results"].push_back(each);
  return json;
}

std::string text(const Json& row, const char* key) {
  return row.at(key).get<std::string>();
}

/// Whether rows are of different light fields.
bool has_several_truths(const std::vector<Json>& rows) {
  return std::ranges::any_of(
      rows, [&](const Json& row) { return row["truth"] != rows.front()["truth"]; });
}

TextTable results_table(const EvaluateRequest& request, const JudgedResults& judged) {
  constexpr int exact_digits = 6;
  const int digits = request.format == Format::Csv ? exact_digits : 3;
  std::vector<std::string> keys = request.metrics.empty() ? judged.keys : request.metrics;
  std::erase_if(keys, [&](const std::string& key) {
    return std::ranges::none_of(judged.rows, [&](const Json& row) { return row.contains(key); });
  });
  const bool has_truths = has_several_truths(judged.rows);
  TextTable table{{"file", "method"}, {}};
  if (has_truths) table.header.emplace_back("truth");
  table.header.insert(table.header.end(), keys.begin(), keys.end());
  table.header.emplace_back("seconds");
  keys.emplace_back("seconds");
  const bool has_classes = request.protocol == Protocol::Vmv2013;
  if (has_classes) table.header.insert(table.header.end(), {"runtime_class", "all_views"});
  for (const Json& row : judged.rows) {
    std::vector<std::string> cells{text(row, "file"), text(row, "method")};
    if (has_truths) cells.push_back(text(row, "truth"));
    for (const auto& key : keys) {
      cells.push_back(row.contains(key) ? fixed_text(row[key].get<double>(), digits) : "");
    }
    if (has_classes) {
      cells.push_back(row.value("runtime_class", ""));
      cells.emplace_back(row["all_views"] ? "yes" : "no");
    }
    table.rows.push_back(std::move(cells));
  }
  return table;
}

/// What the numbers of a single truth were taken for.
std::string truth_line(const std::vector<Json>& rows) {
  const std::string units = rows.front().value("truth_units", "");
  return has_several_truths(rows) || units.empty() ? "" : "\ntruth: " + units;
}

void print_results(const EvaluateRequest& request, const JudgedResults& judged, const Job& job) {
  const std::vector<Json>& rows = judged.rows;
  if (request.format == Format::Json) {
    std::vector<std::string> written;
    for (const Json& row : rows) {
      if (row.contains("error_map")) written.push_back(row["error_map"]);
    }
    return print_answer(results_json(request, judged), job.notes(), written);
  }
  if (rows.empty()) return;
  const TextTable table = results_table(request, judged);
  if (request.format == Format::Csv) {
    std::cout << table_to_csv(table);
  } else if (request.format == Format::Latex) {
    std::cout << table_to_latex(table);
  } else {
    std::cout << protocol_name(request.protocol) << " against "
              << (has_several_truths(rows) ? "the truth of each" : text(rows.front(), "truth"))
              << ", view " << rows.front()["view"][0] << ',' << rows.front()["view"][1]
              << truth_line(rows) << "\nmissing values count as " << missing_rule(request.invalid)
              << "\n\n"
              << table_to_narrow_text(table);
  }
}

/// Names the pictures that were written, where the answer itself is for programs as notes.
void tell_error_maps(const EvaluateRequest& request, const std::vector<Json>& rows, Job& job) {
  for (const Json& row : rows) {
    if (!row.contains("error_map") || request.format == Format::Json) continue;
    const std::string line = text(row, "error_map") + ": error of " + text(row, "file");
    if (request.format == Format::Text) {
      std::cout << line << '\n';
    } else {
      job.note("wrote " + line);
    }
  }
}

/// The scene that results are judged against: read again where a result is of another one, or was
/// estimated from other views of it, at another focus plane.
class TruthScene {
 public:
  TruthScene(const EvaluateRequest& request, const Progress& progress)
      : request_(request), progress_(progress) {}

  /// The scene as this result needs it. Throws as `options_for_result` and `load_input`.
  [[nodiscard]] const Scene& of(const JudgedFile& file) {
    const io::OpenOptions options = options_for_result(file.result, io::read_reading(file.result),
                                                       file.truth, request_.read.options.values());
    const ParameterSet given = io::given_options(options);
    if (!scene_ || file.truth != input_ || given != given_) {
      scene_.reset();
      scene_ = load_input(file.truth, options, true, progress_);
      input_ = file.truth;
      given_ = given;
    }
    return *scene_;
  }

 private:
  const EvaluateRequest& request_;
  Progress progress_;
  std::optional<Scene> scene_;
  std::string input_;
  ParameterSet given_;
};

/// Those that are asked for, in that order.
Metrics chosen(const Metrics& all, const std::vector<std::string>& keys) {
  if (keys.empty()) return all;
  Metrics metrics;
  for (const std::string& key : keys) {
    if (const auto value = find_metric(all, key)) metrics.emplace_back(key, *value);
  }
  return metrics;
}

/// Judges one result after the other.
class Judge {
 public:
  Judge(const EvaluateRequest& request, Job& job)
      : request_(request),
        options_{
            .protocol = request.protocol, .invalid = request.invalid, .progress = job.progress()},
        reading_(map_reading(request.map)),
        job_(job),
        truth_(request, job.progress().part(0, 0.8)) {}

  /// Judges a result and writes its error map, unless that path is empty. Throws InvalidInput,
  /// IoError, Cancelled.
  [[nodiscard]] Json judge_file(const JudgedFile& file, const std::filesystem::path& error_map) {
    const Scene& scene = truth_.of(file);
    const LightField& light_field = *scene.light_field;
    require_no_truth(file, scene.convention);
    job_.progress().check();
    job_.progress().step("evaluating " + file.result);
    const auto estimate =
        std::make_shared<Estimate>(read_result_of(light_field, file.result, reading_));
    const auto wanted =
        request_.view ? std::optional(view_of(light_field, *request_.view)) : std::nullopt;
    const ViewIndex view = view_to_judge(*estimate, scene, wanted);
    place_foreign_map(view, *estimate);
    require_own_samples(file, *estimate, light_field);
    const JudgedResult judged = judged_in(view, file, *estimate, scene);
    know_keys(judged.evaluation->metrics);
    for (const std::string& sentence : judged.notes) job_.note(file.result + ": " + sentence);
    for (const std::string& warning : truth_warnings(scene.convention)) {
      if (told_.insert(file.truth + warning).second) job_.note(file.truth + ": " + warning);
    }
    Json row{{"file", file.result}, {"method", {}}, {"truth", file.truth}};
    row.update(judged_json(*estimate, scene, judged, request_.protocol,
                           chosen(judged.evaluation->metrics, request_.metrics)));
    if (error_map.empty()) return row;
    write_error_map(error_map, {.quantity = render::Quantity::SignedError,
                                .view = view,
                                .estimate = estimate,
                                .evaluation = judged.evaluation});
    row["error_map"] = error_map.string();
    return row;
  }
  /// Throws UsageError for a key that none of the results has.
  void require_known_keys() const {
    for (const std::string& key : request_.metrics) {
      if (std::ranges::find(keys_, key) == keys_.end()) throw unknown_name("metric", key, keys_);
    }
  }
  /// Of all metrics so far.
  [[nodiscard]] const std::vector<std::string>& keys() const { return keys_; }

 private:
  /// The ground truth itself would have no error.
  static void require_no_truth(const JudgedFile& file, const ConventionReport& report) {
    const auto is_result = [&](const fs::path& truth) {
      std::error_code error;
      return fs::equivalent(truth, file.result, error);
    };
    if (std::ranges::none_of(report.truth_files, is_result)) return;
    throw IoError(file.result, "this file is read as the ground truth of " + file.truth +
                                   " itself; move an estimate out of the folder, or call it "
                                   "…_estimate");
  }

  /// A result that names its light field itself is of that alone.
  void require_own_samples(const JudgedFile& file, const Estimate& estimate,
                           const LightField& light_field) {
    if (!file.is_own) return;
    if (estimate.source_hash == 0 || is_of_other_samples(estimate, light_field)) {
      throw IoError(file.result, "its light field, " + file.truth +
                                     ", does not have the samples that it was estimated from; name "
                                     "the one to judge by with --truth INPUT");
    }
    job_.note(file.result + ": judged against " + file.truth +
              ", which it was estimated from; the samples are the same");
  }

  [[nodiscard]] JudgedResult judged_in(ViewIndex view, const JudgedFile& file,
                                       const Estimate& estimate, const Scene& scene) const {
    try {
      return judge_result(estimate, scene, options_, view);
    } catch (const InvalidInput& error) {
      throw IoError(file.result, error.what());
    }
  }
  void know_keys(const Metrics& metrics) {
    for (const auto& [key, value] : metrics) {
      if (std::ranges::find(keys_, key) == keys_.end()) keys_.push_back(key);
    }
  }

  void write_error_map(const std::filesystem::path& path, const MapSource& source) const {
    const auto picture = map_picture(*make_map(source), shading_of(source.quantity, {}));
    write_output(path, request_.overwrite,
                 [&](const std::filesystem::path& to) { io::write_picture(to, picture.view()); });
  }

  const EvaluateRequest& request_;
  EvaluationOptions options_;
  io::MapReading reading_;
  Job& job_;
  TruthScene truth_;
  std::vector<std::string> keys_;
  std::set<std::string> told_;  ///< Warnings of truths, each said once.
};

/// Judges all. One of several that fails is noted and does not stop the others.
JudgedResults judge_all(const std::vector<JudgedFile>& files,
                        const std::vector<std::filesystem::path>& maps, const InputStream& input,
                        Judge& judge, Job& job) {
  JudgedResults judged;
  for (std::size_t i = 0; i < files.size(); ++i) {
    const std::string shown = input.shown(files[i].result);
    try {
      if (!files[i].problem.empty()) throw Error(files[i].problem);
      judged.rows.push_back(judge.judge_file(files[i], maps[i]));
      judged.rows.back()["file"] = shown;
    } catch (const UsageError&) {
      throw;
    } catch (const Error& error) {
      if (files.size() == 1) throw;
      const std::string text = error.what();
      const std::string sentence = text.starts_with(files[i].result) ? text : shown + ": " + text;
      judged.failed.push_back({{"file", shown}});
      if (!files[i].truth.empty()) judged.failed.back()["truth"] = files[i].truth;
      judged.failed.back()["error"] = sentence;
      job.note(sentence);
    }
    job.progress().report(0.8 + 0.2 * static_cast<double>(i + 1) / files.size());
  }
  judged.keys = judge.keys();
  return judged;
}

void check_error_map(const std::filesystem::path& map, const JudgedFile& file) {
  if (map.empty()) return;
  check_output_file(map);
  protect_input(map, file.truth);
}

}  // namespace

void run_evaluate(const VerbArguments& arguments, std::stop_token stop) {
  EvaluateRequest request;
  if (!parse(arguments, request)) return;
  const InputStream input(request.files, stop);
  Job job(std::move(stop), request.job);
  const std::vector<JudgedFile> files =
      judged_files(request.files, request.truth, request.read, job);
  const auto maps = error_map_paths(request, files);
  for (std::size_t i = 0; i < files.size(); ++i) check_error_map(maps[i], files[i]);

  Judge judge(request, job);
  const JudgedResults judged = judge_all(files, maps, input, judge, job);
  if (!judged.rows.empty()) judge.require_known_keys();
  job.finish();
  print_results(request, judged, job);
  tell_error_maps(request, judged.rows, job);
  Failures failures;
  for (const Json& each : judged.failed) failures.add(text(each, "error"));
  failures.require_none(files.size(), "results");
}

}  // namespace episcope::cli
