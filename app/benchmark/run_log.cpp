// SPDX-License-Identifier: BSD-3-Clause
#include "app/benchmark/run_log.h"

#include "app/session/judge.h"
#include "engine/core/error.h"
#include "engine/core/version.h"
#include "engine/io/base/files.h"
#include "engine/io/base/json.h"

#include <nlohmann/json.hpp>

#include <algorithm>

namespace episcope {

RunLog::RunLog(const std::filesystem::path& folder, const std::filesystem::path& file)
    : RunRecords(folder), log_(file, io::LogFraming::Lines, io::LogFlush::AtOnce) {
  for (const io::LogRecord& line : log_.records()) {
    if (auto record = record_from_json({line.begin(), line.end()})) keep(std::move(*record));
  }
}

void RunLog::add(const BenchmarkRecord& record) {
  log_.append(record_to_json(record));
  keep(record);
}

void RunLog::take_over(const std::vector<BenchmarkRecord>& records) {
  std::vector<io::LogRecord> lines;
  for (const BenchmarkRecord& record : records) {
    const BenchmarkRecord* known = last(record.key, record.result.scene);
    const std::string line = record_to_json(record);
    const bool is_worse = known && !known->result.has_failed && record.result.has_failed;
    if (is_worse || (known && record_to_json(*known) == line)) continue;
    lines.emplace_back(line.begin(), line.end());
    keep(record);
  }
  log_.append_all(lines);
}

namespace {

using Json = nlohmann::ordered_json;

BenchmarkRecord read_record(const Json& json) {
  BenchmarkRecord record;
  record.key = json.at("key");
  record.input = json.at("input");
  record.files = json.at("files");
  BenchmarkRun& run = record.run;
  run.kind = value_named<RunKind>(json.at("kind"));
  run.method = json.at("method");
  run.revision = json.at("revision");
  run.parameters = io::parameters_from(json.at("parameters"));
  run.views = value_named<ViewSelection>(json.at("views"));
  if (json.contains("device")) run.device = value_named<Device>(json.at("device"));
  BenchmarkResult& result = record.result;
  result.entry = run.method;
  result.scene = json.at("scene");
  result.seconds = json.at("seconds");
  result.has_all_views = run.views == ViewSelection::All;
  result.vmv2013 = metrics_from(json.at("vmv2013"));
  result.benchmark2016 = metrics_from(json.at("benchmark2016"));
  if (json.contains("labels")) result.labels = metrics_from(json.at("labels"));
  result.problem = json.at("problem");
  result.has_failed = json.at("failed");
  result.notes = json.at("notes");
  return record;
}

}  // namespace

Names<RunKind> names_of(RunKind) {
  return {{RunKind::Table, "run"}, {RunKind::Search, "search"}, {RunKind::Labels, "labels"}};
}

BenchmarkRun plan_run(const Estimator& estimator, const ParameterSet& point,
                      const RunOptions& options, RunKind kind) {
  BenchmarkRun run{kind, estimator.info.id, estimator.info.revision, {}, options.views};
  const bool can = std::ranges::count(estimator.info.devices, options.device) > 0;
  if (can) run.device = options.device;
  for (const auto& parameter : estimator.parameters) {
    const auto set = std::find_if(point.begin(), point.end(),
                                  [&](const auto& value) { return value.first == parameter.key; });
    run.parameters.emplace_back(parameter.key,
                                set == point.end() ? parameter.default_value : set->second);
  }
  return run;
}

std::string record_key(const BenchmarkRun& run, const std::string& fingerprint) {
  std::string text = name_of(run.kind);
  for (const std::string& part :
       {fingerprint, run.method, io::parameters_to_json(run.parameters), name_of(run.views),
        std::string(kVersion), std::to_string(run.revision)}) {
    text += "\n" + part;
  }
  if (run.device != Device::Auto) text += "\n" + name_of(run.device);
  return text_fingerprint(text);
}

std::string record_to_json(const BenchmarkRecord& record) {
  const BenchmarkResult& result = record.result;
  Json json;
  json["key"] = record.key;
  json["kind"] = name_of(record.run.kind);
  json["scene"] = result.scene;
  json["input"] = record.input;
  json["method"] = record.run.method;
  json["parameters"] = io::parameters_json(record.run.parameters);
  json["views"] = name_of(record.run.views);
  if (record.run.device != Device::Auto) json["device"] = name_of(record.run.device);
  json["version"] = kVersion;
  json["revision"] = record.run.revision;
  json["seconds"] = result.seconds;
  json["vmv2013"] = metrics_json(result.vmv2013);
  json["benchmark2016"] = metrics_json(result.benchmark2016);
  if (!result.labels.empty()) json["labels"] = metrics_json(result.labels);
  json["problem"] = result.problem;
  json["failed"] = result.has_failed;
  json["notes"] = result.notes;
  json["files"] = record.files;
  return io::json_text(json);
}

std::optional<BenchmarkRecord> record_from_json(const std::string& line) {
  try {
    return read_record(io::parse_json<Json>(line));
  } catch (const Json::exception&) {
    return std::nullopt;
  } catch (const InvalidInput&) {
    return std::nullopt;
  }
}

namespace {

std::string place_name(const std::string& key, const std::string& scene) {
  return key + " " + scene;
}

}  // namespace

void RunRecords::keep(BenchmarkRecord record) {
  for (const auto& file : record.files) writers_[file] = record.key;
  places_[place_name(record.key, record.result.scene)] = records_.size();
  records_.push_back(std::move(record));
}

void RunRecords::read(const std::filesystem::path& log) {
  if (!io::is_there(log)) return;
  for (const io::LogRecord& line : io::read_log(log, io::LogFraming::Lines)) {
    if (auto record = record_from_json({line.begin(), line.end()})) keep(std::move(*record));
  }
}

const BenchmarkRecord* RunRecords::find(const std::string& key, const std::string& scene) const {
  const BenchmarkRecord* record = last(key, scene);
  if (!record || record->result.has_failed) return nullptr;
  const auto is_own = [&](const std::string& file) {
    return writers_.at(file) == key && io::is_there(folder_ / file);
  };
  return std::all_of(record->files.begin(), record->files.end(), is_own) ? record : nullptr;
}

const BenchmarkRecord* RunRecords::last(const std::string& key, const std::string& scene) const {
  const auto place = places_.find(place_name(key, scene));
  return place == places_.end() ? nullptr : &records_[place->second];
}

std::vector<BenchmarkRecord> RunRecords::last_of_each() const {
  std::vector<std::size_t> order;
  order.reserve(places_.size());
  for (const auto& [name, place] : places_) order.push_back(place);
  std::sort(order.begin(), order.end());
  std::vector<BenchmarkRecord> last;
  last.reserve(order.size());
  for (const std::size_t place : order) last.push_back(records_[place]);
  return last;
}

namespace {

/// Raised when a metric changes its meaning, so that kept results are judged anew.
constexpr int kMetricRules = 2;

/// The view that is judged: the center, else the only one that there is.
void add_truth(Fingerprint& fingerprint, const DisparityField& field, ViewIndex center) {
  if (field.empty()) return;
  const DisparityView view = field.view(field.contains(center) ? center : field.disparity.first());
  fingerprint.add_image(view.disparity);
  if (!view.valid.empty()) fingerprint.add_image(view.valid);
}

}  // namespace

std::string scene_fingerprint(const Scene& scene) {
  const LightField& light_field = *scene.light_field;
  const GroundTruth& truth = *scene.truth;
  Fingerprint fingerprint;
  fingerprint.add_value(kMetricRules);
  fingerprint.add_value(light_field.sample_hash());
  const CameraGrid& camera = light_field.info().camera;
  for (const double number : {camera.baseline, camera.focal_length, camera.shift}) {
    fingerprint.add_value(number);
  }
  const Interval range = light_field.info().disparity_range.value_or(Interval{});
  fingerprint.add_value(range.min);
  fingerprint.add_value(range.max);
  for (const DisparityField* field : {&truth.field, &truth.foreground, &truth.background}) {
    add_truth(fingerprint, *field, light_field.center());
    fingerprint.add("|");
  }
  for (const auto& [name, mask] : truth.regions) {
    fingerprint.add(name);
    fingerprint.add_image(mask.view());
  }
  if (truth.high_res) fingerprint.add(truth.high_res->identity());
  return fingerprint.text();
}

std::string text_fingerprint(const std::string& text) {
  Fingerprint fingerprint;
  fingerprint.add(text);
  return fingerprint.text();
}

}  // namespace episcope
