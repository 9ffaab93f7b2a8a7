// SPDX-License-Identifier: BSD-3-Clause
#include "app/benchmark/run/record.h"

#include "app/benchmark/run/scene_fingerprint.h"
#include "app/session/judge/metrics_json.h"
#include "engine/core/error.h"
#include "engine/core/version.h"
#include "engine/io/maps/parameter_json.h"

#include <nlohmann/json.hpp>

#include <algorithm>

namespace episcope {
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
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::optional<BenchmarkRecord> record_from_json(const std::string& line) {
  try {
    return read_record(Json::parse(line));
  } catch (const Json::exception&) {
    return std::nullopt;
  } catch (const InvalidInput&) {
    return std::nullopt;
  }
}

}  // namespace episcope
