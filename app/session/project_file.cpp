// SPDX-License-Identifier: BSD-3-Clause
#include "app/session/project_file.h"

#include "annotation/scribble_layer.h"
#include "app/session/capture_work.h"
#include "app/session/judge.h"
#include "app/session/load_scene.h"
#include "app/session/result_files.h"
#include "engine/core/error.h"
#include "engine/core/hash.h"
#include "engine/disparity/registry.h"
#include "engine/io/base/atomic_file.h"
#include "engine/io/base/files.h"
#include "engine/io/base/json.h"
#include "engine/io/models/open_options.h"
#include "engine/io/models/result_file.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <set>

namespace episcope {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr const char* kFormat = "episcope project";
constexpr int kProjectVersion = 1;

Json interval_json(Interval interval) {
  return Json::array({interval.min, interval.max});
}

Interval interval_of(const Json& json) {
  return {json.at(0).get<double>(), json.at(1).get<double>()};
}

ViewIndex view_of(const Json& json) {
  return {io::int_of(json.at(0)), io::int_of(json.at(1))};
}

PixelIndex pixel_of(const Json& json) {
  return {io::int_of(json.at(0)), io::int_of(json.at(1))};
}

constexpr std::array<const char*, 4> kCompareModes{"single", "wipe", "sides", "tiles"};

Json comparison_json(const Comparison& comparison) {
  return {{"mode", kCompareModes[static_cast<std::size_t>(comparison.mode)]},
          {"wipe", comparison.wipe_position},
          {"difference", comparison.shows_difference}};
}

// A mode of a later program is left out.
Comparison comparison_of(const Json& json) {
  const auto found = std::ranges::find(kCompareModes, json.at("mode").get<std::string>());
  const auto mode = found == kCompareModes.end()
                        ? CompareMode::Single
                        : static_cast<CompareMode>(found - kCompareModes.begin());
  return {mode, json.at("wipe"), json.at("difference")};
}

constexpr const char* kAlongRow = "row";

Json measured_json(const Measurements& measured) {
  Json list = Json::array();
  for (const EpiMeasurement& each : measured.list) {
    const bool is_row = each.direction == EpiDirection::Horizontal;
    list.push_back({{"name", each.name},
                    {"along", is_row ? kAlongRow : "column"},
                    {"view", {each.view.v, each.view.u}},
                    {"pixel", {each.pixel.y, each.pixel.x}},
                    {"disparity_px", each.disparity_px}});
  }
  return {{"current", measured.current}, {"lines", list}};
}

Measurements measured_of(const Json& json) {
  Measurements measured;
  for (const Json& each : json.at("lines")) {
    measured.list.push_back(
        {each.at("name"),
         each.at("along") == kAlongRow ? EpiDirection::Horizontal : EpiDirection::Vertical,
         view_of(each.at("view")), pixel_of(each.at("pixel")), each.at("disparity_px")});
  }
  measured.current = io::int_of(json.at("current"));
  return measured;
}

Json place_json(const ScenePlace& place) {
  Json ranges = Json::object();
  for (const auto& [quantity, range] : place.ranges) {
    ranges[render::info_of(quantity).id] = interval_json(range);
  }
  Json json{{"view", {place.view.v, place.view.u}},
            {"pixel", {place.cross_hair.y, place.cross_hair.x}},
            {"focus_px", place.focus_px},
            {"ranges", ranges}};
  if (!place.tone.is_plain()) {
    json["tone"] = {{"black", place.tone.black},
                    {"exposure", place.tone.exposure},
                    {"gamma", place.tone.gamma}};
  }
  if (place.label_marks != LabelMarks{}) {
    json["labels"] = {{"hidden", place.label_marks.hidden}, {"locked", place.label_marks.locked}};
  }
  if (!place.measured.list.empty()) json["measured"] = measured_json(place.measured);
  if (place.comparison != Comparison{}) json["comparison"] = comparison_json(place.comparison);
  if (place.quantity) json["quantity"] = render::info_of(*place.quantity).id;
  return json;
}

std::set<std::int32_t> label_ids(const Json& json) {
  std::set<std::int32_t> ids;
  for (const Json& each : json) {
    const int id = io::int_of(each);
    if (id >= 1 && id <= LabelSet::kMaxId) ids.insert(id);
  }
  return ids;
}

ScenePlace place_of(const Json& json) {
  ScenePlace place;
  place.view = view_of(json.at("view"));
  place.cross_hair = pixel_of(json.at("pixel"));
  place.focus_px = json.at("focus_px").get<double>();
  if (const auto* shown = render::find_quantity(json.value("quantity", ""))) {
    place.quantity = shown->quantity;
  }
  if (json.contains("tone")) {
    const Json& tone = json.at("tone");
    place.tone = {tone.at("black"), tone.at("exposure"), tone.at("gamma")};
  }
  if (json.contains("labels")) {
    const Json& labels = json.at("labels");
    place.label_marks = {label_ids(labels.at("hidden")), label_ids(labels.at("locked"))};
  }
  if (json.contains("measured")) place.measured = measured_of(json.at("measured"));
  if (json.contains("comparison")) place.comparison = comparison_of(json.at("comparison"));
  for (const auto& [id, range] : json.at("ranges").items()) {
    if (const auto* known = render::find_quantity(id)) {
      place.ranges[known->quantity] = interval_of(range);
    }
  }
  return place;
}

constexpr std::array<const char*, 6> kJudged{"whole",  "rectangle", "label",
                                             "common", "mask",      "region"};

Json judged_json(const JudgedPart& part, const fs::path& project) {
  Json json{{"pixels", kJudged[static_cast<std::size_t>(part.pixels)]}};
  const PixelRect& r = part.rectangle;
  if (!r.empty()) json["rectangle"] = {r.y0, r.x0, r.y1, r.x1};
  if (!part.mask.empty()) json["mask"] = source_text(part.mask, project);
  if (!part.region.empty()) json["region"] = part.region;
  return json;
}

Json result_json(const EstimateEntry& result, const fs::path& project) {
  Json json{{"name", result.name},
            {"file", source_text(result.kept.string(), project)},
            {"display_range", interval_json(result.display_range)},
            {"shown", false},
            {"compared", false}};
  if (result.is_saved) json["saved"] = true;
  if (!result.note.empty()) json["note"] = result.note;
  if (!result.foreign_file.empty()) json["foreign_file"] = result.foreign_file.string();
  return json;
}

// Those that could not be read come last, and are neither shown nor compared.
Json results_json(const ProjectScene& scene, const fs::path& project) {
  Json results = Json::array();
  for (const EstimateEntry& each : scene.estimates) {
    Json json = result_json(each, project);
    json["shown"] = each.id == scene.shown;
    if (each.id == scene.compared)
      json[scene.is_compared_chosen ? "compared" : "shown_before"] = true;
    results.push_back(std::move(json));
  }
  for (const EstimateEntry& each : scene.unread) results.push_back(result_json(each, project));
  return results;
}

Json scene_json(const ProjectScene& scene, const fs::path& project) {
  Json json{{"name", scene.name},
            {"source", source_text(scene.input, project)},
            {"hash", hash_digits(scene.sample_hash)},
            {"reading", io::parameters_json(scene.reading)},
            {"place", place_json(scene.place)},
            {"results", results_json(scene, project)}};
  const CaptureWork& capture = scene.place.capture;
  if (!capture.empty()) json["capture"] = io::parse_json<Json>(capture_to_json(capture, project));
  const JudgedPart& judged = scene.place.judged;
  if (judged != JudgedPart{}) json["judged"] = judged_json(judged, project);
  if (!scene.strokes.empty()) json["strokes"] = source_text(scene.strokes.string(), project);
  if (!scene.labels.file.empty()) {
    json["labels"] = {{"file", source_text(scene.labels.file.string(), project)},
                      {"strokes_hash", hash_digits(scene.labels.strokes)}};
  }
  return json;
}

// What a later program can choose is the whole view here.
JudgedPart judged_of(const Json& json, const fs::path& project) {
  JudgedPart part;
  const auto found = std::ranges::find(kJudged, json.at("pixels").get<std::string>());
  if (found != kJudged.end()) part.pixels = static_cast<JudgedPixels>(found - kJudged.begin());
  if (json.contains("rectangle")) {
    const Json& r = json.at("rectangle");
    part.rectangle = {io::int_of(r.at(0)), io::int_of(r.at(1)), io::int_of(r.at(2)),
                      io::int_of(r.at(3))};
  }
  if (json.contains("mask")) part.mask = absolute_path(json.at("mask"), project);
  part.region = json.value("region", "");
  return part;
}

void add_result(const Json& json, const fs::path& project, ProjectScene& scene) {
  EstimateEntry& result = scene.estimates.emplace_back();
  result.id = static_cast<int>(scene.estimates.size());
  result.name = json.at("name");
  result.kept = absolute_path(json.at("file"), project);
  result.display_range = interval_of(json.at("display_range"));
  result.is_saved = json.value("saved", false);
  result.note = json.value("note", "");
  result.foreign_file = json.value("foreign_file", "");
  if (json.at("shown")) scene.shown = result.id;
  if (json.at("compared")) scene.is_compared_chosen = true;
  if (json.at("compared") || json.value("shown_before", false)) scene.compared = result.id;
}

ProjectScene scene_of(const Json& json, const fs::path& project) {
  ProjectScene scene;
  scene.name = json.at("name");
  const std::string source = json.at("source");
  scene.input = builtin_scene_id(source).empty() ? absolute_path(source, project) : source;
  scene.sample_hash = hash_from_digits(json.at("hash").get<std::string>());
  scene.reading = io::stored_options(io::parameters_from(json.at("reading")));
  scene.place = place_of(json.at("place"));
  for (const Json& each : json.at("results")) add_result(each, project, scene);
  if (json.contains("capture")) {
    scene.place.capture = capture_from_json(io::json_text(json.at("capture")), project);
  }
  if (json.contains("judged")) scene.place.judged = judged_of(json.at("judged"), project);
  if (json.contains("strokes")) scene.strokes = absolute_path(json.at("strokes"), project);
  if (json.contains("labels")) {
    scene.labels.file = absolute_path(json.at("labels").at("file"), project);
    scene.labels.strokes =
        hash_from_digits(json.at("labels").at("strokes_hash").get<std::string>());
  }
  return scene;
}

Json point_json(const SweepPoint& point) {
  Json json{{"values", io::parameters_json(point.point)},
            {"seconds", point.seconds},
            {"display_range", interval_json(point.display_range)},
            {"vmv2013", metrics_json(point.vmv2013)},
            {"benchmark2016", metrics_json(point.benchmark2016)}};
  if (point.change_px) json["change_px"] = *point.change_px;
  if (!point.problem.empty()) json["problem"] = point.problem;
  return json;
}

SweepPoint point_of(const Json& json) {
  SweepPoint point;
  point.point = io::parameters_from(json.at("values"));
  point.seconds = json.at("seconds");
  point.display_range = interval_of(json.at("display_range"));
  point.vmv2013 = metrics_from(json.at("vmv2013"));
  point.benchmark2016 = metrics_from(json.at("benchmark2016"));
  if (json.contains("change_px")) point.change_px = json.at("change_px").get<double>();
  point.problem = json.value("problem", "");
  return point;
}

// Its light fields by their place in the project.
Json sweep_json(const Sweep& sweep, const std::vector<ProjectScene>& scenes) {
  Json json{{"method", sweep.base.method},
            {"parameters", io::parameters_json(sweep.base.parameters)},
            {"varied", Json::array()},
            {"scenes", Json::array()}};
  for (const SweptParameter& each : sweep.swept) {
    Json values = Json::array();
    for (const ParameterValue& value : each.values) {
      values.push_back(io::parameters_json({{each.key, value}}).at(each.key));
    }
    json["varied"].push_back({{"parameter", each.key}, {"values", values}});
  }
  for (const SweepScene& each : sweep.scenes) {
    const auto scene = std::ranges::find(scenes, each.scene, &ProjectScene::id);
    if (scene == scenes.end()) continue;
    Json points = Json::array();
    for (const SweepPoint& point : each.points) points.push_back(point_json(point));
    json["scenes"].push_back({{"scene", scene - scenes.begin()}, {"points", points}});
  }
  return json;
}

SweptParameter swept_of(const Json& json) {
  SweptParameter swept;
  swept.key = json.at("parameter");
  for (const Json& value : json.at("values")) {
    swept.values.push_back(io::parameters_from({{swept.key, value}}).at(0).second);
  }
  return swept;
}

Sweep sweep_of(const Json& json, const std::vector<ProjectScene>& scenes) {
  Sweep sweep;
  sweep.base.method = json.at("method");
  sweep.base.parameters = io::parameters_from(json.at("parameters"));
  sweep.base.options.views = ViewSelection::Center;
  for (const Json& each : json.at("varied")) sweep.swept.push_back(swept_of(each));
  for (const Json& each : json.at("scenes")) {
    const int place = io::int_of(each.at("scene"));
    if (place < 0 || place >= std::ssize(scenes)) continue;
    const ProjectScene& scene = scenes[static_cast<std::size_t>(place)];
    SweepScene& added = sweep.scenes.emplace_back();
    added.scene = scene.id;
    added.name = scene.name;
    for (const Json& point : each.at("points")) added.points.push_back(point_of(point));
  }
  return sweep;
}

bool is_swept(const SweepPoint& point, const std::vector<SweptParameter>& swept) {
  return std::ranges::all_of(swept, [&](const SweptParameter& each) {
    return std::ranges::count(point.point, each.key, &ParameterSet::value_type::first) == 1;
  });
}

// A later program may have other methods and parameters.
bool is_known(const Sweep& sweep) {
  const Estimator* method = known_estimator(sweep.base.method);
  if (!method || sweep.swept.empty() || sweep.scenes.empty()) return false;
  const auto is_number = [](const ParameterValue& value) {
    return std::holds_alternative<int>(value) || std::holds_alternative<double>(value);
  };
  return std::ranges::all_of(sweep.swept,
                             [&](const SweptParameter& each) {
                               const auto known = std::ranges::find(method->parameters, each.key,
                                                                    &ParameterDescription::key);
                               return known != method->parameters.end() && can_sweep(*known) &&
                                      std::ranges::all_of(each.values, is_number);
                             }) &&
         std::ranges::all_of(sweep.scenes, [&](const SweepScene& scene) {
           return std::ranges::all_of(scene.points, [&](const SweepPoint& point) {
             return is_swept(point, sweep.swept) &&
                    std::ranges::all_of(point.point,
                                        [&](const auto& value) { return is_number(value.second); });
           });
         });
}

/// The sweeps of a project: what was asked for, and the numbers of the points. Maps are not part of
/// it: they are computed again when they are looked at.
Json sweeps_json(const Project& project) {
  Json json = Json::array();
  for (const Sweep& each : project.sweeps) json.push_back(sweep_json(each, project.scenes));
  return json;
}

/// Reads them. Those of methods or parameters that this program does not know are left out, as are
/// light fields that are not among `scenes`. Throws nlohmann::json::exception and InvalidInput for
/// what is no list of sweeps.
std::vector<Sweep> sweeps_of(const Json& json, const std::vector<ProjectScene>& scenes) {
  std::vector<Sweep> sweeps;
  for (const Json& each : json) {
    Sweep sweep = sweep_of(each, scenes);
    if (is_known(sweep)) sweeps.push_back(std::move(sweep));
  }
  return sweeps;
}

Project project_of(const Json& json, const fs::path& path) {
  if (json.at("format") != kFormat) throw IoError(path, "is no project of Episcope");
  if (io::int_of(json.at("version")) > kProjectVersion) {
    throw IoError(path, "was written by a newer Episcope; open it with that one");
  }
  Project project;
  for (const Json& each : json.at("scenes")) {
    project.scenes.push_back(scene_of(each, fs::absolute(path)));
    project.scenes.back().id = project.scenes.size();
  }
  if (json.contains("sweeps")) project.sweeps = sweeps_of(json.at("sweeps"), project.scenes);
  project.current = static_cast<std::size_t>(std::max(0, io::int_of(json.at("current"))));
  project.bad_threshold_px = json.at("bad_threshold_px");
  project.saved_as = json.value("saved_as", "");
  return project;
}

IoError damaged(const fs::path& path, const std::exception& error) {
  return {path, std::string("is no whole project file (") + error.what() +
                    "); open another, or restore it from a copy"};
}

void require_files_beside(const Project& project, const fs::path& path) {
  const OwnFolders own(path);
  const auto require = [&](const fs::path& file) {
    if (file.empty() || own.contain(file)) return;
    throw IoError(path, "names " + file.string() +
                            ", which is not in the folder of the project; move it there, or open "
                            "it by itself");
  };
  for (const ProjectScene& scene : project.scenes) {
    require(scene.strokes);
    require(scene.labels.file);
    for (const EstimateEntry& result : scene.estimates) require(result.kept);
  }
}

}  // namespace

bool names_project(const fs::path& path) {
  return path.extension() == kProjectSuffix;
}

void write_project(const fs::path& path, const Project& project) {
  Json json{{"format", kFormat},
            {"version", kProjectVersion},
            {"current", project.current},
            {"bad_threshold_px", project.bad_threshold_px},
            {"scenes", Json::array()}};
  if (!project.saved_as.empty()) json["saved_as"] = project.saved_as.string();
  for (const ProjectScene& each : project.scenes) {
    json["scenes"].push_back(scene_json(each, fs::absolute(path)));
  }
  if (!project.sweeps.empty()) json["sweeps"] = sweeps_json(project);
  // Names of other systems may be no UTF-8.
  const std::string text = io::json_text(json, 1) + '\n';
  io::write_atomically(path, text);
}

Project read_project(const fs::path& path, ProjectFiles files) {
  try {
    Project project = project_of(io::read_json<Json>(path), path);
    if (files == ProjectFiles::Beside) require_files_beside(project, path);
    return project;
  } catch (const Json::exception& error) {
    throw damaged(path, error);
  } catch (const InvalidInput& error) {
    throw damaged(path, error);
  }
}

std::string work_text(const ScenePlace& place) {
  ScenePlace work;
  work.tone = place.tone;
  work.label_marks = place.label_marks;
  work.measured.list = place.measured.list;
  work.capture = place.capture;
  for (CaptureObject& each : work.capture.objects) each.pose.reset();
  return io::json_text(Json{{"place", place_json(work)},
                            {"judged", judged_json(place.judged, "/")},
                            {"capture", capture_to_json(work.capture, "/")}});
}

fs::path files_of_project(const fs::path& project) {
  return fs::absolute(project).lexically_normal().parent_path() /
         (project.stem().string() + "_files");
}

OwnFolders::OwnFolders(const fs::path& project)
    : folder_(fs::absolute(project).lexically_normal().parent_path()),
      files_(files_of_project(project)) {}

bool OwnFolders::contain(const fs::path& file) const {
  const fs::path normal = file.lexically_normal();
  return io::is_inside_folder(normal, folder_) || io::is_inside_folder(normal, files_);
}

void forget_file_elsewhere(JournalOwner& owner, const OwnFolders& own) {
  if (!own.contain(owner.file)) owner.file.clear();
}

}  // namespace episcope
