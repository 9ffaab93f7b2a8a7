// SPDX-License-Identifier: BSD-3-Clause
#include "app/session/capture_work.h"

#include "app/session/result_files.h"
#include "app/session/user_folders.h"
#include "engine/capture/view_surface.h"
#include "engine/core/error.h"
#include "engine/core/schema.h"
#include "engine/core/text.h"
#include "engine/io/base/json.h"
#include "engine/io/formats/write_scene.h"
#include "engine/io/models/result_file.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <utility>

namespace episcope {

const CaptureObject* CaptureWork::object() const {
  const bool is_there = current >= 0 && current < static_cast<int>(objects.size());
  return is_there ? &objects[static_cast<std::size_t>(current)] : nullptr;
}

CaptureLens lens_of(const capture::Calibration& calibration) {
  CaptureLens lens{.camera = calibration.camera};
  for (const capture::PatternPhotograph& each : calibration.photographs) {
    lens.photographs.push_back(
        {std::filesystem::path(each.name).filename().string(), each.rms, each.problem});
  }
  return lens;
}

std::string solve_poses(CaptureWork& work, const CameraGrid& camera) {
  std::string problem;
  for (CaptureObject& object : work.objects) {
    object.pose.reset();
    if (!camera.pinhole || object.pairs.size() < 4) continue;
    try {
      object.pose = capture::solve_pose(object.pairs, camera);
    } catch (const InvalidInput& error) {
      if (&object == work.object()) problem = error.what();
    }
  }
  return problem;
}

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

// What cannot be told is left out: JSON has no numbers for it.
void put(Json& json, const char* key, double value) {
  if (std::isfinite(value)) json[key] = value;
}

Json camera_json(const capture::LensCamera& camera) {
  return {{"size_px", {camera.width, camera.height}},
          {"focal_px", {camera.focal_x, camera.focal_y}},
          {"center_px", {camera.center_x, camera.center_y}},
          {"distortion", camera.distortion},
          {"error_px", camera.rms}};
}

capture::LensCamera camera_of(const Json& json) {
  capture::LensCamera camera;
  camera.width = io::int_of(json.at("size_px").at(0));
  camera.height = io::int_of(json.at("size_px").at(1));
  camera.focal_x = json.at("focal_px").at(0);
  camera.focal_y = json.at("focal_px").at(1);
  camera.center_x = json.at("center_px").at(0);
  camera.center_y = json.at("center_px").at(1);
  json.at("distortion").get_to(camera.distortion);
  camera.rms = json.at("error_px");
  return camera;
}

Json lens_json(const CaptureLens& lens, const fs::path& project) {
  Json json = camera_json(lens.camera);
  if (!lens.file.empty()) json["file"] = source_text(lens.file, project);
  for (const CalibratedPhotograph& each : lens.photographs) {
    Json photograph{{"name", each.name}};
    if (each.problem.empty()) photograph["error_px"] = each.rms;
    if (!each.problem.empty()) photograph["left_out"] = each.problem;
    json["photographs"].push_back(photograph);
  }
  return json;
}

CaptureLens lens_from(const Json& json, const fs::path& project) {
  CaptureLens lens{.camera = camera_of(json)};
  if (json.contains("file")) lens.file = absolute_path(json.at("file"), project);
  for (const Json& each : json.value("photographs", Json::array())) {
    lens.photographs.push_back(
        {each.at("name"), each.value("error_px", 0.0), each.value("left_out", "")});
  }
  return lens;
}

template <class P>
Json settings_json(const Schema<P>& schema, const P& value) {
  return io::parameters_json(schema.values(value));
}

// Settings that a later program wrote otherwise are those of a new light field.
template <class P>
P settings_of(const Schema<P>& schema, const Json& json) {
  try {
    return schema.parse(io::parameters_from(json));
  } catch (const InvalidInput&) {
    return {};
  }
}

Json rows_json(const RowAlignment& rows) {
  return {{"before_px", {rows.before.median, rows.before.percentile_95}},
          {"after_px", {rows.after.median, rows.after.percentile_95}}};
}

RowAlignment rows_of(const Json& json) {
  const Json& before = json.at("before_px");
  const Json& after = json.at("after_px");
  return {{before.at(0), before.at(1)}, {after.at(0), after.at(1)}};
}

Json pairs_json(const CaptureObject& object) {
  Json pairs = Json::array();
  for (std::size_t i = 0; i < object.pairs.size(); ++i) {
    const capture::PointPair& each = object.pairs[i];
    pairs.push_back({{"name", each.name},
                     {"pixel", {each.x_px, each.y_px}},
                     {"point", {each.point.x, each.point.y, each.point.z}}});
    if (each.is_locked) pairs.back()["locked"] = true;
    if (!object.pose) continue;
    put(pairs.back(), "off_px", object.pose->pairs[i].residual_px);
    if (object.pose->pairs[i].is_outlier) pairs.back()["wrong"] = true;
  }
  return pairs;
}

Json pose_json(const capture::SolvedPose& solved) {
  Json json{{"rotation", solved.pose.rotation}, {"translation", solved.pose.translation}};
  put(json, "reprojection_error_px", solved.reprojection_error_px);
  put(json, "delta_tz", solved.delta_tz);
  put(json, "delta_tz_px", solved.delta_tz_px);
  return json;
}

capture::SolvedPose pose_of(const Json& json, const Json& pairs) {
  capture::SolvedPose solved;
  json.at("rotation").get_to(solved.pose.rotation);
  json.at("translation").get_to(solved.pose.translation);
  solved.reprojection_error_px = json.value("reprojection_error_px", kUnknown);
  solved.delta_tz = json.value("delta_tz", kUnknown);
  solved.delta_tz_px = json.value("delta_tz_px", kUnknown);
  for (const Json& each : pairs) {
    solved.pairs.push_back({each.value("off_px", kUnknown), each.value("wrong", false)});
  }
  return solved;
}

Json object_json(const CaptureObject& object, const fs::path& project) {
  Json json{{"name", object.name}};
  if (!object.mesh.empty()) json["mesh"] = source_text(object.mesh, project);
  json["pairs"] = pairs_json(object);
  if (object.pose) json["pose"] = pose_json(*object.pose);
  return json;
}

CaptureObject object_of(const Json& json, const fs::path& project) {
  CaptureObject object;
  object.name = json.value("name", "1");
  if (json.contains("mesh")) object.mesh = absolute_path(json.at("mesh"), project);
  for (const Json& each : json.at("pairs")) {
    const Json& point = each.at("point");
    object.pairs.push_back({each.at("name"),
                            each.at("pixel").at(0),
                            each.at("pixel").at(1),
                            {point.at(0), point.at(1), point.at(2)},
                            each.value("locked", false)});
  }
  if (json.contains("pose")) object.pose = pose_of(json.at("pose"), json.at("pairs"));
  return object;
}

// Of a program that knew one object only.
CaptureWork former_work_of(const Json& json, const fs::path& project) {
  CaptureWork work;
  work.objects.push_back(object_of(json, project));
  CaptureObject& object = work.objects[0];
  if (!object.mesh.empty()) object.name = fs::path(object.mesh).stem().string();
  return work;
}

}  // namespace

std::string capture_to_json(const CaptureWork& work, const fs::path& project) {
  Json json = Json::object();
  if (work.lens) json["lens"] = lens_json(*work.lens, project);
  json["pattern"] = settings_json(capture::pattern_schema(), work.pattern);
  json["rectify"] = settings_json(capture::rectify_schema(), work.rectify);
  if (work.rows) json["rows"] = rows_json(*work.rows);
  json["objects"] = Json::array();
  for (const CaptureObject& each : work.objects) {
    json["objects"].push_back(object_json(each, project));
  }
  json["current"] = work.current;
  return io::json_text(json);
}

CaptureWork capture_from_json(const std::string& text, const fs::path& project) {
  const auto json = io::parse_json<Json>(text);
  if (!json.contains("objects")) return former_work_of(json, project);
  CaptureWork work;
  if (json.contains("lens")) work.lens = lens_from(json.at("lens"), project);
  work.pattern = settings_of(capture::pattern_schema(), json.at("pattern"));
  work.rectify = settings_of(capture::rectify_schema(), json.at("rectify"));
  if (json.contains("rows")) work.rows = rows_of(json.at("rows"));
  for (const Json& each : json.at("objects")) work.objects.push_back(object_of(each, project));
  const int last = static_cast<int>(work.objects.size()) - 1;
  work.current = std::clamp(io::int_of(json.at("current")), 0, std::max(last, 0));
  return work;
}

namespace {

GroundTruth depth_of(std::span<const PosedMesh> meshes, const LightField& field, GridShape grid,
                     const capture::DepthOptions& options, const Progress& progress) {
  std::vector<capture::PlacedMesh> placed;
  for (const PosedMesh& each : meshes) placed.push_back({each.mesh.get(), each.pose});
  const capture::DepthGrid cameras{grid, field.height(), field.width(), field.info().camera};
  return capture::visible_depth(placed, cameras, options, progress);
}

}  // namespace

Estimate mesh_estimate(std::span<const PosedMesh> meshes, const Scene& scene,
                       const Progress& progress) {
  const auto begin = std::chrono::steady_clock::now();
  const LightField& field = *scene.light_field;
  GroundTruth truth = depth_of(meshes, field, {1, 1}, {}, progress);
  Estimate estimate;
  estimate.method = "mesh";
  estimate.source = field.info().source;
  estimate.reading = field.info().reading;
  estimate.field = std::move(truth.field);
  estimate.field.disparity.keep_in_place({0, 0}, {1, 1}, field.center());
  estimate.field.valid.keep_in_place({0, 0}, {1, 1}, field.center());
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
  estimate.seconds = took.count();
  return estimate;
}

Scene with_mesh_truth(std::span<const PosedMesh> meshes, const Scene& scene,
                      const Progress& progress, const capture::DepthOptions& options) {
  Scene made = scene;
  made.truth = std::make_shared<GroundTruth>(
      depth_of(meshes, *scene.light_field, scene.light_field->grid(), options, progress));
  return made;
}

RectifiedFile rectify_to_file(RectifyTask task, const Progress& progress) {
  const capture::LensCamera& camera = task.work.lens->camera;
  RectifiedFile made{capture::rectify(*task.photographs.light_field, camera, task.work.rectify,
                                      progress.part(0, 0.9)),
                     task.work};
  Scene scene = std::move(task.photographs);
  scene.light_field = made.rectified.light_field;
  scene.truth = std::make_shared<GroundTruth>();
  scene.scribbles = {};
  io::write_archive(task.output, scene, progress.part(0.9, 1));
  made.work.rows = {made.rectified.before, made.rectified.after};
  for (CaptureObject& object : made.work.objects) {
    object.pose.reset();
    for (capture::PointPair& pair : object.pairs) {
      const capture::PlanePoint place = made.rectified.center_pixel(camera, {pair.x_px, pair.y_px});
      pair.x_px = place.x;
      pair.y_px = place.y;
    }
  }
  return made;
}

namespace {

std::size_t bytes_of(const CaptureWork& work) {
  std::size_t bytes = sizeof(CaptureWork);
  if (work.lens) bytes += work.lens->photographs.size() * sizeof(CalibratedPhotograph);
  for (const CaptureObject& object : work.objects) {
    bytes += sizeof(CaptureObject) + object.pairs.size() * sizeof(capture::PointPair);
    if (object.pose) bytes += object.pose->pairs.size() * sizeof(capture::PairResidual);
  }
  return bytes;
}

template <class Named>
bool is_taken(const std::vector<Named>& all, const std::string& name) {
  return std::ranges::find(all, name, &Named::name) != all.end();
}

/// `stem`, with a number where that is empty or taken.
template <class Named>
std::string free_name(const std::vector<Named>& all, const std::string& stem) {
  if (!stem.empty()) {
    return unique_name(stem, " ", [&](const std::string& name) { return is_taken(all, name); });
  }
  int number = 1;
  while (is_taken(all, std::to_string(number))) ++number;
  return std::to_string(number);
}

void append_object(CaptureWork& work, const std::string& mesh) {
  work.current = static_cast<int>(work.objects.size());
  work.objects.push_back(
      {.name = free_name(work.objects, std::filesystem::path(mesh).stem().string()), .mesh = mesh});
}

}  // namespace

std::size_t CaptureEdit::byte_size() const {
  return bytes_of(before) + bytes_of(after);
}

CaptureDocument::CaptureDocument(CaptureWork work) : work_(std::move(work)) {
  if (!work_.object()) work_.current = 0;
}

const std::vector<capture::PointPair>& CaptureDocument::pairs() const {
  static const std::vector<capture::PointPair> kNone;
  const CaptureObject* object = work_.object();
  return object ? object->pairs : kNone;
}

void CaptureDocument::edit(const std::function<void(CaptureWork&)>& change) {
  CaptureWork changed = work_;
  change(changed);
  if (changed == work_) return;
  history_.push({work_, changed});
  work_ = std::move(changed);
}

void CaptureDocument::edit_object(const std::function<void(CaptureObject&)>& change) {
  edit([&](CaptureWork& work) {
    if (!work.object()) append_object(work, {});
    change(work.objects[static_cast<std::size_t>(work.current)]);
  });
}

void CaptureDocument::set_lens(CaptureLens lens, const capture::Pattern& pattern) {
  edit([&](CaptureWork& work) {
    work.lens = std::move(lens);
    work.pattern = pattern;
  });
}

void CaptureDocument::set_rectify(const capture::RectifyOptions& options) {
  edit([&](CaptureWork& work) { work.rectify = options; });
}

void CaptureDocument::add_object(const std::string& mesh) {
  edit([&](CaptureWork& work) { append_object(work, mesh); });
}

void CaptureDocument::remove_object() {
  edit([](CaptureWork& work) {
    if (!work.object()) return;
    work.objects.erase(work.objects.begin() + work.current);
    work.current = std::max(0, std::min(work.current, static_cast<int>(work.objects.size()) - 1));
  });
}

void CaptureDocument::rename_object(const std::string& name) {
  if (!work_.object() || name.empty() || is_taken(work_.objects, name)) return;
  edit_object([&](CaptureObject& object) { object.name = name; });
}

void CaptureDocument::choose(int object) {
  if (object >= 0 && object < static_cast<int>(work_.objects.size())) work_.current = object;
}

void CaptureDocument::set_mesh(const std::string& file) {
  if (!work_.object()) return add_object(file);
  edit_object([&](CaptureObject& object) { object.mesh = file; });
}

void CaptureDocument::add_pairs(std::vector<capture::PointPair> pairs) {
  if (pairs.empty()) return;
  edit_object([&](CaptureObject& object) {
    for (capture::PointPair& pair : pairs) {
      pair.name = free_name(object.pairs, pair.name);
      object.pairs.push_back(std::move(pair));
    }
  });
}

void CaptureDocument::remove_pairs(const std::vector<int>& places) {
  edit_object([&](CaptureObject& object) {
    for (auto place = places.rbegin(); place != places.rend(); ++place) {
      if (!object.pairs[*place].is_locked) object.pairs.erase(object.pairs.begin() + *place);
    }
  });
}

void CaptureDocument::lock_pair(int place, bool is_locked) {
  edit_object([&](CaptureObject& object) { object.pairs[place].is_locked = is_locked; });
}

void CaptureDocument::rename_pair(int place, const std::string& name) {
  if (name.empty() || is_taken(pairs(), name) || name.find_first_of(",\n\r") != std::string::npos) {
    return;
  }
  edit_object([&](CaptureObject& object) { object.pairs[place].name = name; });
}

void CaptureDocument::undo() {
  if (!history_.next_undo()) return;
  work_ = history_.next_undo()->before;
  history_.undo();
}

void CaptureDocument::redo() {
  if (!history_.next_redo()) return;
  work_ = history_.next_redo()->after;
  history_.redo();
}

}  // namespace episcope
