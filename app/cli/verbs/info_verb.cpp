// SPDX-License-Identifier: BSD-3-Clause
#include "app/cli/arguments.h"
#include "app/cli/input.h"
#include "app/cli/output.h"
#include "app/cli/streams.h"
#include "app/cli/verbs/verbs.h"
#include "app/session/command_line.h"
#include "app/session/load_scene.h"
#include "app/session/project_file.h"
#include "app/session/result_files.h"
#include "app/session/scene_summary.h"
#include "engine/capture/camera.h"
#include "engine/capture/solve_pose.h"
#include "engine/core/camera_grid.h"
#include "engine/core/error.h"
#include "engine/core/finding.h"
#include "engine/core/hash.h"
#include "engine/core/parameter.h"
#include "engine/core/scene.h"
#include "engine/core/text.h"
#include "engine/io/base/files.h"
#include "engine/io/base/hdf5_file.h"
#include "engine/io/base/json.h"
#include "engine/io/models/labels/label_import.h"
#include "engine/io/models/result_file.h"
#include "engine/io/models/scribble_file.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iostream>
#include <limits>
#include <numeric>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace episcope::cli {
namespace {

namespace fs = std::filesystem;

/// What `info` tells of a file.
struct FileInfo {
  std::vector<std::pair<std::string, std::string>> lines;  ///< Label and text, in order.
  Json json;
};

/// Whether options of reading are given, which make views of arrays and pictures.
enum class Reads { AsItIs, AsViews };

/// Adds `camera`, if it is known.
void add_camera(const CameraGrid& camera, Json& json) {
  if (!camera.is_known()) return;
  json["camera"] = Json::object({{"baseline", camera.baseline},
                                 {"focal_length", camera.focal_length},
                                 {"shift", camera.shift}});
  if (camera.cam_distance) json["camera"]["cam_distance"] = *camera.cam_distance;
}

/// "baseline 1, focal length 2, shift 0 px", or that it is not known.
std::string camera_text(const CameraGrid& camera) {
  if (!camera.is_known()) return "not known: disparity has no depth";
  const std::string distance =
      camera.cam_distance ? fmt::format(", d = 0 at Z = {:g}", *camera.cam_distance) : "";
  return fmt::format("baseline {:g}, focal length {:g}, shift {:g} px{}", camera.baseline,
                     camera.focal_length, camera.shift, distance);
}

/// "-1.5 … 2.25 px".
std::string range_text(const Interval& range) {
  return fmt::format("{:.4g} … {:.4g} px", range.min, range.max);
}

/// Adds when a file was written last.
void add_date(const std::string& file, FileInfo& info) {
  std::error_code error;
  const auto time = fs::last_write_time(file, error);
  if (error) return;  // it was removed meanwhile
  const auto since_1970 = std::chrono::file_clock::to_sys(time).time_since_epoch();
  const std::string text =
      time_text(std::chrono::duration_cast<std::chrono::seconds>(since_1970).count());
  info.json["date"] = text;
  info.lines.emplace_back("date", text);
}

/// What a file says of the run that made it.
void add_made_by(const Provenance& made, const std::string& file, FileInfo& info) {
  Json& json = info.json;
  const bool is_there = !existing_source(made.source, file).empty();
  json["parameters"] = io::parameters_json(made.parameters);
  if (made.seconds > 0) json["seconds"] = made.seconds;
  if (!made.version.empty()) json["version"] = made.version;
  if (!made.source.empty()) {
    json["source"] = made.source;
    json["source_exists"] = is_there;
  }
  if (!made.reading.reader.empty()) {
    json["reader"] = made.reading.reader;
    json["reading"] = io::parameters_json(made.reading.options);
  }
  info.lines.emplace_back("parameters", joined(made.parameters, ", ", [](const auto& each) {
                            return each.first + " " + to_text(each.second);
                          }));
  if (made.seconds > 0) info.lines.emplace_back("seconds", fmt::format("{:.4g}", made.seconds));
  const std::string gone = made.source.empty() || is_there ? "" : ", which is not there";
  info.lines.emplace_back("source",
                          made.source + reading_options_text(made.reading.options) + gone);
  info.lines.emplace_back("version", made.version.empty() ? "" : "Episcope " + made.version);
  add_date(file, info);
}

/// What a result says of its run beyond that: program, machine and light field.
void add_run(const Provenance& made, FileInfo& info) {
  const auto add = [&info](const char* key, const std::string& text) {
    if (text.empty()) return;
    info.json[key] = text;
    info.lines.emplace_back(key, text);
  };
  add("commit", made.commit);
  add("device", made.device);
  add("finished", made.date);
  if (made.source_hash != 0) add("source_hash", hash_digits(made.source_hash));
  add_camera(made.camera, info.json);
  if (made.camera.is_known()) info.lines.emplace_back("camera", camera_text(made.camera));
}

std::string views_text(GridShape grid, ViewIndex first) {
  if (grid.count() == 1) return "view " + view_text(first);
  return fmt::format("{}×{} views", grid.v, grid.u);
}

FileInfo describe_result(const std::string& file) {
  const Estimate estimate = read_result_alone(file);
  const auto& maps = estimate.field.disparity;
  const auto [range, valid_percent] = summarize(estimate.field);
  const bool is_own = io::is_result_file(file);
  const bool has_range = !(estimate.range == Interval{});
  FileInfo info{{}, {{"input", file}, {"kind", "result"}}};
  Json& json = info.json;
  if (is_own) json["method"] = estimate.method;
  json["views"] = Json::object({{"v", maps.grid().v}, {"u", maps.grid().u}});
  if (is_own) json["first_view"] = view_json(maps.first());
  json["height"] = maps.height();
  json["width"] = maps.width();
  json["valid_percent"] = valid_percent;
  json["disparity"] = interval_json(range);
  if (has_range) json["range"] = interval_json(estimate.range);
  json["confidence"] = !estimate.confidence.empty();
  json["second"] = !estimate.second.empty();
  json["layers"] = estimate.layered.foreground.empty() ? 1 : 2;

  const std::string views = is_own ? views_text(maps.grid(), maps.first())
                                   : fmt::format("{}×{} views", maps.grid().v, maps.grid().u);
  info.lines = {
      {"result", is_own ? "of " + estimate.method : "a map of another program"},
      {"shape", fmt::format("{} of {}×{} px{}{}{}", views, maps.width(), maps.height(),
                            estimate.confidence.empty() ? "" : ", with confidence",
                            estimate.second.empty() ? "" : ", second disparity",
                            estimate.layered.foreground.empty() ? "" : ", two layers")},
      {"disparity", fmt::format("{}, {:.4g} % of the pixels", range_text(range), valid_percent)}};
  if (has_range) info.lines.emplace_back("searched", range_text(estimate.range));
  add_made_by(estimate, file, info);
  add_run(estimate, info);
  json["notes"] = estimate.notes;
  json["findings"] = findings_json(estimate.notes);
  for (const std::string& note : estimate.notes) info.lines.emplace_back("note", note);
  return info;
}

FileInfo describe_labels(const std::string& file) {
  const io::SegmentationFile labels(file);
  const Image<std::int32_t> first = labels.labels(labels.first());
  FileInfo info{{}, {{"input", file}, {"kind", "labels"}}};
  Json& json = info.json;
  json["views"] = Json::object({{"v", labels.grid().v}, {"u", labels.grid().u}});
  json["first_view"] = view_json(labels.first());
  json["height"] = first.height();
  json["width"] = first.width();
  json["labels"] = Json::array();
  for (const LabelInfo& label : labels.infos()) {
    json["labels"].push_back(
        Json::object({{"id", label.id}, {"name", label.name}, {"color", label.color}}));
  }
  json["probabilities"] = labels.has_probabilities();
  info.lines = {{"labels", joined(labels.infos(), ", ",
                                  [](const LabelInfo& label) {
                                    return std::to_string(label.id) + " " + label.name;
                                  })},
                {"shape", fmt::format("{} of {}×{} px{}", views_text(labels.grid(), labels.first()),
                                      first.width(), first.height(),
                                      labels.has_probabilities() ? ", with probabilities" : "")}};
  add_made_by(labels_provenance(file), file, info);
  return info;
}

constexpr const char* kScribbles = "SCRIBBLES";

/// Ids of labels in a map, ascending.
std::vector<int> ids_in(const io::Hdf5Input& labels, const io::Hdf5Dataset& map) {
  std::vector<int> ids;
  io::Hdf5Block line{io::Hdf5Shape(map.shape.size(), 0), map.shape};
  line.count[0] = 1;
  const std::size_t size =
      std::accumulate(map.shape.begin() + 1, map.shape.end(), std::size_t{1}, std::multiplies<>());
  std::vector<std::int32_t> values(size);
  for (line.start[0] = 0; line.start[0] < map.shape[0]; ++line.start[0]) {
    labels.read(map.name, line, values.data());
    collect_ids(values, ids);
  }
  return ids;
}

/// Whether a file has labels of the archive, but no light field.
bool is_label_archive(const fs::path& path) {
  if (!io::has_hdf5_signature(path) || !io::holds_labels_only(path)) return false;
  const io::Hdf5Input file(path);
  return file.has_numbers(io::kTrueLabels) || file.has_numbers(kScribbles);
}

FileInfo describe_label_archive(const std::string& file) {
  const io::Hdf5Input labels(file);
  FileInfo info{{}, {{"input", file}, {"kind", "labels"}, {"maps", Json::array()}}};
  for (const char* name : {io::kTrueLabels, kScribbles}) {
    if (!labels.has_numbers(name)) continue;
    const io::Hdf5Dataset map = labels.dataset(name);
    const std::vector<int> ids = ids_in(labels, map);
    info.json["maps"].push_back(Json::object({{"name", name}, {"shape", map.shape}, {"ids", ids}}));
    const auto text = [](auto number) { return std::to_string(number); };
    info.lines.emplace_back(
        name == std::string(kScribbles) ? "scribbles" : "labels",
        fmt::format("{}: {}, ids {}", name, joined(map.shape, "×", text), joined(ids, ", ", text)));
  }
  add_date(file, info);
  return info;
}

void add_project_scene(const ProjectScene& scene, bool is_shown, FileInfo& info) {
  const auto gone = [](bool is_there) { return is_there ? "" : ", which is not there"; };
  const bool has_source = is_there(scene.input, scene.reading);
  const bool has_strokes = !scene.strokes.empty();
  info.lines.emplace_back(
      is_shown ? "shown" : "scene",
      fmt::format("{}, {}{}{}{}", scene.name, scene.input, reading_options_text(scene.reading),
                  gone(has_source), has_strokes ? ", with strokes" : ""));
  Json results = Json::array();
  for (const EstimateEntry& result : scene.estimates) {
    const bool exists = io::is_there(result.kept);
    results.push_back(
        Json::object({{"name", result.name}, {"file", result.kept.string()}, {"exists", exists}}));
    info.lines.emplace_back("  result",
                            result.name + ", " + result.kept.filename().string() + gone(exists));
  }
  info.json["scenes"].push_back(Json::object({{"name", scene.name},
                                              {"source", scene.input},
                                              {"source_exists", has_source},
                                              {"reading", io::parameters_json(scene.reading)},
                                              {"shown", is_shown},
                                              {"strokes", has_strokes},
                                              {"results", std::move(results)}}));
}

FileInfo describe_project(const std::string& file) {
  const Project project = read_project(file);
  FileInfo info{{}, {{"input", file}, {"kind", "project"}, {"scenes", Json::array()}}};
  info.lines = {{"project", fmt::format("{} light field{}", project.scenes.size(),
                                        project.scenes.size() == 1 ? "" : "s")}};
  for (std::size_t i = 0; i < project.scenes.size(); ++i) {
    add_project_scene(project.scenes[i], i == project.current, info);
  }
  add_date(file, info);
  return info;
}

FileInfo describe_camera(const std::string& file) {
  const capture::LensCamera camera = capture::read_camera(file);
  FileInfo info{{}, {{"input", file}, {"kind", "camera"}}};
  Json& json = info.json;
  json["width"] = camera.width;
  json["height"] = camera.height;
  json["focal_length_px"] = std::vector<double>{camera.focal_x, camera.focal_y};
  json["center_px"] = std::vector<double>{camera.center_x, camera.center_y};
  json["distortion"] = std::vector<double>(camera.distortion.begin(), camera.distortion.end());
  json["rms"] = camera.rms;
  info.lines = {{"camera", fmt::format("photographs of {}×{} px", camera.width, camera.height)},
                {"focal", fmt::format("length {:.2f} × {:.2f} px", camera.focal_x, camera.focal_y)},
                {"center", fmt::format("({:.2f}, {:.2f}) px", camera.center_x, camera.center_y)},
                {"distortion", joined(camera.distortion, ", ",
                                      [](double value) { return fmt::format("{:.4g}", value); }) +
                                   " (k1, k2, p1, p2, k3)"},
                {"error", fmt::format("{:.3f} px", camera.rms)}};
  add_date(file, info);
  return info;
}

FileInfo describe_pose(const std::string& file) {
  const capture::PoseStory story = capture::read_pose(file);
  const capture::SolvedPose& solved = story.solved;
  const auto outliers =
      std::ranges::count_if(solved.pairs, [](const auto& pair) { return pair.is_outlier; });
  const bool has_mesh = io::is_there(story.mesh);
  FileInfo info{{}, {{"input", file}, {"kind", "pose"}}};
  Json& json = info.json;
  json["mesh"] = story.mesh.string();
  json["mesh_exists"] = has_mesh;
  json["light_field"] = story.light_field;
  json["rotation"] = std::vector<double>(solved.pose.rotation.begin(), solved.pose.rotation.end());
  json["translation"] =
      std::vector<double>(solved.pose.translation.begin(), solved.pose.translation.end());
  if (!story.pairs.empty()) {
    json["reprojection_error_px"] = solved.reprojection_error_px;
    json["delta_tz"] = solved.delta_tz;
    json["pairs"] = story.pairs.size();
    json["outliers"] = outliers;
  }
  const auto text = [](double value) { return fmt::format("{:.4g}", value); };
  info.lines = {{"pose", "of " + story.mesh.string() + (has_mesh ? "" : ", which is not there")},
                {"source", story.light_field},
                {"place", joined(solved.pose.translation, ", ", text) + " (X, Y, Z)"}};
  if (!story.pairs.empty()) {
    info.lines.emplace_back(
        "pairs", fmt::format("{}, {} of them wrong picks", story.pairs.size(), outliers));
    info.lines.emplace_back("error", fmt::format("{:.3f} px, depth {:.3g} (unit of the mesh)",
                                                 solved.reprojection_error_px, solved.delta_tz));
  }
  add_date(file, info);
  return info;
}

/// JSON with a rotation and a translation, as `pose` writes it.
bool is_pose(const fs::path& path) {
  if (suffix_of(path) != ".json") return false;
  std::ifstream in(path);
  const auto json = io::json_or_null<Json>(std::string(std::istreambuf_iterator<char>(in), {}));
  return json.is_object() && json.contains("rotation") && json.contains("translation");
}

/// Describes a result, labels, also those of the archive, a project of the window, a camera or a
/// pose. Nothing for what else there is, such as light fields. Throws IoError for a damaged file.
std::optional<FileInfo> describe_file(const std::string& input, Reads reads) {
  if (!builtin_scene_id(input).empty() || !io::is_file(input)) return {};
  if (io::is_segmentation_file(input)) return describe_labels(input);
  if (reads == Reads::AsItIs && is_label_archive(input)) return describe_label_archive(input);
  if (names_project(input)) return describe_project(input);
  const std::string suffix = suffix_of(input);
  if (suffix == ".yml" || suffix == ".yaml") return describe_camera(input);
  if (is_pose(input)) return describe_pose(input);
  if (reads == Reads::AsItIs && names_result(input)) return describe_result(input);
  return {};
}

/// Keys of what there is; what is missing has no key.
void add_truth(Json& json, const Scene& scene, const SceneSummary& summary) {
  if (const auto& promised = scene.light_field->info().disparity_range) {
    json["disparity_promised"] = interval_json(*promised);
  }
  if (summary.truth) {
    json["truth"] = Json::object({{"views", summary.truth->views},
                                  {"valid_percent", summary.truth->valid_percent},
                                  {"disparity", interval_json(summary.truth->all)}});
    if (const auto& center = summary.truth->center) {
      json["truth"]["disparity_center"] = interval_json(*center);
    }
  }
  for (const auto& [key, estimated] :
       {std::pair{"truth_estimated", &scene.truth->estimated},
        std::pair{"labels_estimated", &scene.truth->labels_estimated}}) {
    if (!*estimated) continue;
    json[key] = Json::object({{"method", (*estimated)->method},
                              {"parameters", io::parameters_json((*estimated)->parameters)},
                              {"source", (*estimated)->source},
                              {"version", (*estimated)->version}});
  }
  if (summary.has_layers) json["truth_layers"] = 2;
  if (!summary.label_ids.empty()) {
    json["labels"] = Json::object({{"views", summary.label_views}, {"ids", summary.label_ids}});
  }
  if (summary.painted_percent > 0) {
    Json views = Json::array();
    for (const ViewScribbles& one : scene.scribbles.views) views.push_back(view_json(one.view));
    json["scribbles"] = Json::object({{"view", view_json(scene.scribbles.views.front().view)},
                                      {"views", views},
                                      {"painted_percent", summary.painted_percent},
                                      {"ids", summary.scribble_ids}});
  }
  if (!scene.truth->regions.empty()) {
    json["regions"] = Json::array();
    for (const auto& [name, mask] : scene.truth->regions) json["regions"].push_back(name);
  }
}

/// Where cameras stand, view by view; how many pixels are valid.
void add_cameras(Json& json, const LightField& light_field) {
  if (!light_field.info().positions.empty()) {
    Json positions = Json::array();
    for (const CameraPosition& at : light_field.info().positions) {
      positions.push_back(Json::array({at.x, at.y}));
    }
    json["positions"] =
        Json::object({{"unit", light_field.info().position_unit}, {"xy", std::move(positions)}});
  }
  if (!light_field.valid().empty()) json["valid_pixels"] = valid_percent(light_field);
}

Json files_json(const std::vector<FileUse>& files) {
  Json json = Json::object({{"used", Json::array()}, {"unused", Json::array()}});
  for (const FileUse& use : files) {
    json[use.is_used ? "used" : "unused"].push_back(
        Json::object({{"kind", use.kind}, {"count", use.count}, {"example", use.example}}));
  }
  return json;
}

/// What `info` tells of a scene that was read from `input`. Keys of what is missing are absent.
Json scene_json(const Scene& scene, const std::string& input) {
  const SceneSummary summary = summarize(scene);
  const LightField& light_field = *scene.light_field;
  Json json;
  json["input"] = input;
  json["name"] = light_field.info().name;
  json["format"] = scene.convention.format;
  if (scene.sequence.count > 0) {
    json["sequence"] =
        Json::object({{"frame", scene.sequence.frame}, {"count", scene.sequence.count}});
  }
  json["views"] = Json::object({{"v", light_field.grid().v}, {"u", light_field.grid().u}});
  json["height"] = light_field.height();
  json["width"] = light_field.width();
  json["channels"] = light_field.channels();
  json["sample_type"] = summary.sample_type;
  json["samples"] = samples_text(scene);
  json["brightness"] = scene.convention.gain;
  json["bytes"] = light_field.byte_size();
  add_camera(light_field.info().camera, json);
  add_truth(json, scene, summary);
  json["companions"] = Json::array();
  for (const auto& companion : scene.companions) {
    json["companions"].push_back(Json::object({{"kind", companion_name(companion.kind)},
                                               {"path", companion.path.string()},
                                               {"shape", companion.shape}}));
  }
  json["focus"] = scene.convention.focus_px;
  json["order"] = order_text(scene.convention);
  json["order_check"] = scene.convention.order_check;
  json["sign"] = scene.convention.sign.empty() ? "unknown" : "checked";
  json["sign_check"] = scene.convention.sign_check;
  json["files"] = files_json(scene.convention.files);
  add_cameras(json, light_field);
  json["units"] = units_text(scene.convention);
  json["warnings"] = scene.convention.warnings;
  json["findings"] = findings_json(scene.convention.warnings);
  return json;
}

void print_line(const std::string& label, const std::string& text) {
  constexpr std::size_t column = 12;
  if (!text.empty()) std::cout << label << std::string(column - label.size(), ' ') << text << '\n';
}

std::string ids_text(const std::vector<int>& ids) {
  return joined(ids, ", ", [](int id) { return std::to_string(id); });
}

/// "(how it was checked)" behind what was found.
std::string checked_text(const std::string& found, const std::string& check) {
  return check.empty() ? found : found + " (" + check + ")";
}

void print_shape(const LightField& light_field, const SceneSummary& summary) {
  print_line("shape",
             fmt::format("{}×{} views of {}×{} px, {}, {}, {:.3g} MiB", light_field.grid().v,
                         light_field.grid().u, light_field.width(), light_field.height(),
                         light_field.channels() == 3 ? "RGB" : "gray", summary.sample_type,
                         static_cast<double>(light_field.byte_size()) / (1 << 20)));
}

void print_valid(const LightField& light_field) {
  if (light_field.valid().empty()) return;
  print_line("valid", fmt::format("{:.4g} % of the pixels; the others are dark or empty",
                                  valid_percent(light_field)));
}

void print_positions(const LightFieldInfo& info) {
  if (info.positions.empty()) return;
  const CameraPosition first = info.positions.front();
  const CameraPosition last = info.positions.back();
  print_line(
      "positions",
      fmt::format("x {:g} … {:g}, y {:g} … {:g} {}, first to last view", first.x, last.x, first.y,
                  last.y, info.position_unit.empty() ? "(unit not known)" : info.position_unit));
}

void print_true_disparity(const SceneSummary::Truth& truth) {
  print_line(
      "truth",
      fmt::format("disparity of {} view{}, {:.4g} % of the pixels{}{}", truth.views,
                  truth.views == "all" ? "s" : "", truth.valid_percent,
                  truth.center ? ", " + range_text(*truth.center) + " in the center view" : "",
                  truth.all == truth.center ? "" : ", " + range_text(truth.all) + " in all"));
}

void print_truth(const Scene& scene, const SceneSummary& summary) {
  if (const auto& promised = scene.light_field->info().disparity_range) {
    print_line("disparity", range_text(*promised) + ", as the files say");
  }
  if (summary.truth) print_true_disparity(*summary.truth);
  if (const auto& estimated = scene.truth->estimated) {
    print_line("", "not ground truth: " + estimated_text(*estimated));
  }
  if (!summary.truth && !summary.has_layers) print_line("truth", "none");
  if (summary.has_layers) print_line("truth", "two layers: foreground and background");
  if (!summary.label_ids.empty()) {
    print_line("labels", ids_text(summary.label_ids) + " in " + summary.label_views + " view" +
                             (summary.label_views == "all" ? "s" : ""));
  }
  if (const auto& estimated = scene.truth->labels_estimated) {
    print_line("", "not ground truth: " + estimated_text(*estimated));
  }
  if (summary.painted_percent > 0) {
    print_line("scribbles", fmt::format("{:.3g} % of view {}, labels {}", summary.painted_percent,
                                        summary.painted_views, ids_text(summary.scribble_ids)));
  }
  print_line("regions",
             joined(scene.truth->regions, ", ", [](const auto& each) { return each.first; }));
}

void print_scene(const Scene& scene) {
  const SceneSummary summary = summarize(scene);
  print_line("name", scene.light_field->info().name);
  print_line("format", scene.convention.format);
  if (const FrameOfSequence& sequence = scene.sequence; sequence.count > 0) {
    print_line("sequence", "frame " + std::to_string(sequence.frame) + " of " +
                               std::to_string(sequence.count) + ", counted from 0");
  }
  print_shape(*scene.light_field, summary);
  print_line("samples", samples_text(scene));
  print_valid(*scene.light_field);
  print_line("brightness", scene.convention.gain);
  print_line("camera", camera_text(scene.light_field->info().camera));
  print_positions(scene.light_field->info());
  print_truth(scene, summary);
  for (const auto& companion : scene.companions) {
    print_line("beside it", std::string(companion_name(companion.kind)) + ", " + companion.shape +
                                ", " + companion.path.filename().string());
  }
  if (const double focus_px = scene.convention.focus_px; focus_px != 0) {
    print_line("focus", "a plane of " + to_text(focus_px) + " px was baked in: it has 0 now");
  }
  const ConventionReport& how = scene.convention;
  print_line("order", checked_text(order_text(how), how.order_check));
  print_line("sign", checked_text(sign_text(how), how.sign_check));
  print_line("units", units_text(scene.convention));
  print_line("files", files_text(scene.convention));
  for (const auto& said : scene.convention.warnings) {
    print_line(is_note(said) ? "note" : "warning", said);
  }
}

}  // namespace

void run_info(const VerbArguments& arguments, std::stop_token stop) {
  std::string input;
  bool is_json = false;
  JobOptions job_options;
  ReadOptions read;
  Arguments parser(
      "info",
      {"Describes a light field: what it contains, how it was read, and how that was checked.\n"
       "Of a result or of labels: method, parameters, source, version. Of a project of the\n"
       "window, a camera or a pose: what it holds.",
       "episcope-cli info demo --json\n"
       "  episcope-cli info demo.h5"});
  parser.positional(
      "INPUT", input,
      "The light field, a result, labels that 'label' wrote, a project (.episcope), a "
      "camera (.yml) or a pose (.json); - is a map on standard input");
  parser.flag("--json", is_json, "Print one JSON object instead of lines");
  if (!parse_reading(parser, arguments, job_options, read)) return;

  const InputStream piped(input, stop);
  const bool is_plain = read.options.values().empty() || io::is_result_file(input);
  if (auto file = describe_file(input, is_plain ? Reads::AsItIs : Reads::AsViews)) {
    require_no_read_options(read, input);
    if (is_json) return print_answer(std::move(file->json));
    for (const auto& [label, text] : file->lines) print_line(label, text);
    return;
  }
  const Scene scene = [&] {
    const Job job(std::move(stop), job_options);
    return load_input(input, read, job.progress());
  }();
  if (is_json) {
    print_answer(scene_json(scene, piped.shown(input)), scene.convention.warnings);
  } else {
    print_scene(scene);
  }
}

}  // namespace episcope::cli
