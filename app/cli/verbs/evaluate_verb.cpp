// SPDX-License-Identifier: BSD-3-Clause
#include "app/cli/arguments.h"
#include "app/cli/input.h"
#include "app/cli/output.h"
#include "app/cli/verbs/verbs.h"
#include "app/session/known_files.h"
#include "app/session/picture.h"
#include "app/session/result_files.h"
#include "engine/core/text.h"
#include "engine/core/text_table.h"
#include "engine/io/base/image_file.h"
#include "engine/io/models/result_file.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <iostream>
#include <set>

namespace episcope::cli {
namespace {

/// What the answer is written as.
enum class Format { Text, Json, Csv, Latex };

struct EvaluateRequest {
  std::vector<std::string> files;
  std::string truth;
  Protocol protocol = Protocol::Vmv2013;
  InvalidEstimates invalid = InvalidEstimates::Bad;
  std::string error_map;
  Format format = Format::Text;
  ParameterOptions map;
  JobOptions job;
  ReadOptions read;
};

/// One judged result.
struct Row {
  std::string file;
  std::string method;
  double seconds = 0;
  bool has_all_views = false;
  ViewIndex view;
  Metrics metrics;
  std::vector<std::string> notes;
  std::optional<io::BetterReading> better;
  std::string error_map{};  ///< The picture that was written; empty = none.
};

/// The 2013 paper ranks run times in classes.
bool has_runtime_classes(const EvaluateRequest& request) {
  return request.protocol == Protocol::Vmv2013;
}

bool parse(const VerbArguments& arguments, EvaluateRequest& request) {
  Arguments parser("evaluate", {"Compares results with the ground truth of a light field.",
                                "episcope-cli evaluate demo.h5 --truth demo --protocol "
                                "benchmark2016 --error-map error.png"});
  parser.positionals(
      "RESULT", request.files,
      "Result files, HDF5 or .mat (v7.3) files with one map, .npy, PFM, TIFF, submission "
      "folders");
  parser.required_option("--truth", request.truth, text_value("INPUT"),
                         "The light field with its ground truth");
  parser.option("--protocol", request.protocol, choice_of<Protocol>(),
                "Metrics of the 2013 paper or of the 2016 benchmark");
  parser.option("--invalid", request.invalid, choice_of<InvalidEstimates>(),
                "Missing values (NaN): bad counts them as the farthest true disparity and as bad "
                "pixels; compatible as good pixels that means leave out, as the 2016 tool does "
                "(default bad)");
  parser.flag("--json", request.format, Format::Json, "Print one JSON object");
  parser.flag("--csv", request.format, Format::Csv, "Print comma-separated values");
  parser.flag("--latex", request.format, Format::Latex, "Print a LaTeX tabular");
  parser.exclude_each_other({"--json", "--csv", "--latex"});
  parser.option("--error-map", request.error_map, text_value("OUT.png"),
                "Write a picture of truth − estimate; OUT-<result>.png of several results");
  declare_map_options(parser, request.map);
  if (!parse_reading(parser, arguments, request.job, request.read)) return false;
  if (!request.error_map.empty() && suffix_of(request.error_map) != ".png") {
    throw UsageError("evaluate writes error maps as PNG, but the output is " + request.error_map +
                     "; name it OUT.png");
  }
  return true;
}

/// OUT.png for one result; OUT-<result>.png for several, numbered where names repeat. Empty if no
/// error map is wanted.
std::vector<std::filesystem::path> error_map_paths(const EvaluateRequest& request) {
  const std::filesystem::path path = request.error_map;
  if (path.empty()) return {};
  if (request.files.size() == 1) return {path};
  std::vector<std::filesystem::path> paths;
  std::set<std::string> taken;
  for (const auto& file : request.files) {
    const std::filesystem::path result = std::filesystem::path(file).lexically_normal();
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

/// Both numbers, as read and by the options that would fit better.
Json better_reading_json(const io::BetterReading& found) {
  Json json;
  json["options"] = map_options_text(found.reading).substr(1);
  const auto add = [&json](const char* key, std::optional<double> value) {
    if (value) json[key] = *value;
  };
  add("mse_100", found.better.mse_100);
  add("mse_100_as_read", found.as_read.mse_100);
  add("grey_levels", found.better.grey_levels);
  add("grey_levels_as_read", found.as_read.grey_levels);
  return json;
}

Json results_json(const EvaluateRequest& request, const std::vector<Row>& rows) {
  Json json;
  json["protocol"] = protocol_name(request.protocol);
  json["truth"] = request.truth;
  json["view"] = view_json(rows.front().view);
  json["missing_values"] = missing_rule(request.invalid);
  json["results"] = Json::array();
  for (const Row& row : rows) {
    Json result;
    result["file"] = row.file;
    result["method"] = row.method;
    for (const auto& [key, value] : row.metrics) result[key] = value;
    if (row.seconds > 0) {
      result["seconds"] = row.seconds;
      if (has_runtime_classes(request)) result["runtime_class"] = runtime_class(row.seconds);
    }
    result["all_views"] = row.has_all_views;
    if (row.better) result["better_reading"] = better_reading_json(*row.better);
    if (!row.notes.empty()) result["notes"] = row.notes;
    if (!row.error_map.empty()) result["error_map"] = row.error_map;
    json["results"].push_back(result);
  }
  return json;
}

/// Keys of all rows, in the order of their first appearance.
std::vector<std::string> metric_keys(const std::vector<Row>& rows) {
  std::vector<std::string> keys;
  for (const Row& row : rows) {
    for (const auto& [key, value] : row.metrics) {
      if (std::find(keys.begin(), keys.end(), key) == keys.end()) keys.push_back(key);
    }
  }
  return keys;
}

TextTable results_table(const EvaluateRequest& request, const std::vector<Row>& rows) {
  constexpr int exact_digits = 6;
  const int digits = request.format == Format::Csv ? exact_digits : 3;
  const auto keys = metric_keys(rows);
  TextTable table{{"file", "method"}, {}};
  table.header.insert(table.header.end(), keys.begin(), keys.end());
  table.header.emplace_back("seconds");
  const bool has_classes = has_runtime_classes(request);
  if (has_classes) table.header.insert(table.header.end(), {"runtime_class", "all_views"});
  for (const Row& row : rows) {
    std::vector<std::string> cells{row.file, row.method};
    for (const auto& key : keys) {
      const auto value = find_metric(row.metrics, key);
      cells.push_back(value ? fixed_text(*value, digits) : "");
    }
    cells.push_back(row.seconds > 0 ? fixed_text(row.seconds, digits) : "");
    if (has_classes) {
      cells.emplace_back(row.seconds > 0 ? runtime_class(row.seconds) : "");
      cells.emplace_back(row.has_all_views ? "yes" : "no");
    }
    table.rows.push_back(std::move(cells));
  }
  return table;
}

void print_answer(const EvaluateRequest& request, const std::vector<Row>& rows) {
  if (request.format == Format::Json) return print_json(results_json(request, rows));
  const TextTable table = results_table(request, rows);
  if (request.format == Format::Csv) {
    std::cout << table_to_csv(table);
  } else if (request.format == Format::Latex) {
    std::cout << table_to_latex(table);
  } else {
    std::cout << protocol_name(request.protocol) << " against " << request.truth << ", view "
              << view_text(rows.front().view) << "\nmissing values count as "
              << missing_rule(request.invalid) << "\n\n"
              << table_to_narrow_text(table);
  }
}

/// Names the pictures that were written, where the answer itself is for programs as notes.
void tell_error_maps(const EvaluateRequest& request, const std::vector<Row>& rows, Job& job) {
  for (const Row& row : rows) {
    if (row.error_map.empty() || request.format == Format::Json) continue;
    const std::string line = row.error_map + ": error of " + row.file;
    if (request.format == Format::Text) {
      std::cout << line << '\n';
    } else {
      job.note("wrote " + line);
    }
  }
}

/// The scene that results are judged against: read again where a result was estimated from other
/// views of it, at another focus plane.
class TruthScene {
 public:
  TruthScene(const EvaluateRequest& request, const Progress& progress)
      : request_(request), progress_(progress) {}

  /// The scene as this result needs it. Throws as `options_for_result` and `load_input`.
  [[nodiscard]] const Scene& for_result(const std::string& file) {
    const io::OpenOptions options = options_for_result(file, io::read_reading(file), request_.truth,
                                                       request_.read.options.values());
    const ParameterSet given = io::given_options(options);
    if (!scene_ || given != given_) {
      scene_.reset();
      scene_ = load_input(request_.truth, options, true, progress_);
      given_ = given;
    }
    return *scene_;
  }

 private:
  const EvaluateRequest& request_;
  Progress progress_;
  std::optional<Scene> scene_;
  ParameterSet given_;
};

/// A result, and where its error map goes; empty = nowhere.
struct JudgedFile {
  std::string path;
  std::filesystem::path error_map;
  io::MapReading reading;
};

/// Nothing without a path.
void write_error_map(const std::filesystem::path& path, MapSource source) {
  if (path.empty()) return;
  source.quantity = render::Quantity::SignedError;
  io::write_picture(path, map_picture(*make_map(source), shading_of(source.quantity, {})).view());
}

/// Judges one result and writes its error map, if a path is given for it.
Row judge_file(const JudgedFile& result, const Scene& scene, EvaluationOptions options, Job& job) {
  const std::string& file = result.path;
  options.progress = job.progress();
  job.progress().check();
  job.progress().step("evaluating " + file);
  const LightField& light_field = *scene.light_field;
  auto estimate =
      std::make_shared<const Estimate>(read_result_of(light_field, file, result.reading));
  EvaluationPtr evaluation;
  try {
    evaluation = std::make_shared<const Evaluation>(judge(*estimate, scene, options));
  } catch (const InvalidInput& error) {
    throw IoError(file, error.what());
  }
  note_other_source(*estimate, light_field, job);
  std::vector<std::string> notes = evaluation->notes;
  if (!io::is_result_file(file)) {
    notes.insert(notes.begin(), estimate->notes.begin(), estimate->notes.end());
  }
  const auto better = find_better_reading(*estimate, scene);
  if (better) notes.push_back(better_reading_text(*better));
  for (const std::string& sentence : notes) job.note(file + ": " + sentence);
  write_error_map(result.error_map,
                  {.view = judged_view(scene), .estimate = estimate, .evaluation = evaluation});
  return {file,
          estimate->method,
          estimate->seconds,
          estimate->field.disparity.grid() == light_field.grid(),
          judged_view(scene),
          evaluation->metrics,
          std::move(notes),
          better};
}

}  // namespace

void run_evaluate(const VerbArguments& arguments, std::stop_token stop) {
  EvaluateRequest request;
  if (!parse(arguments, request)) return;
  const EvaluationOptions options{request.protocol, request.invalid, {}};
  const io::MapReading reading = io::map_schema().parse(request.map.values());
  check_input(request.truth);
  const auto maps = error_map_paths(request);
  for (const auto& map : maps) {
    check_output_file(map);
    protect_input(map, request.truth);
  }

  std::vector<Row> rows;
  Job job(std::move(stop), request.job);
  TruthScene truth(request, job.progress().part(0, 0.8));
  for (std::size_t i = 0; i < request.files.size(); ++i) {
    const std::filesystem::path map = maps.empty() ? std::filesystem::path() : maps[i];
    const Scene& scene = truth.for_result(request.files[i]);
    rows.push_back(judge_file({request.files[i], map, reading}, scene, options, job));
    rows.back().error_map = map.string();
    job.progress().report(0.8 + 0.2 * static_cast<double>(i + 1) / request.files.size());
  }
  job.finish();
  print_answer(request, rows);
  tell_error_maps(request, rows, job);
}

}  // namespace episcope::cli
