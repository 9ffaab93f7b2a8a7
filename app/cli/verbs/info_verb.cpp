// SPDX-License-Identifier: BSD-3-Clause
#include "app/cli/arguments.h"
#include "app/cli/file_info.h"
#include "app/cli/input.h"
#include "app/cli/output.h"
#include "app/cli/streams.h"
#include "app/cli/verbs/verbs.h"
#include "app/session/scene_summary.h"
#include "engine/core/finding.h"
#include "engine/core/parameter.h"
#include "engine/core/scene.h"
#include "engine/core/text.h"
#include "engine/io/base/json.h"
#include "engine/io/models/result_file.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <iostream>
#include <string>

namespace episcope::cli {
namespace {

/// Keys of what there is; what is missing has no key.
void add_truth(Json& json, const Scene& scene, const SceneSummary& summary) {
  if (const auto& promised = scene.light_field->info().disparity_range) {
    json["disparity_promised"] = interval_json(*promised);
  }
  if (summary.truth) {
    json["truth"] = Json::object({{"views", summary.truth->views},
                                  {"valid_percent", summary.truth->valid_percent},
                                  {"disparity_center", interval_json(summary.truth->center)},
                                  {"disparity", interval_json(summary.truth->all)}});
  }
  if (const auto& estimated = scene.truth->estimated) {
    json["truth_estimated"] =
        Json::object({{"method", estimated->method},
                      {"parameters", io::parameters_json(estimated->parameters)},
                      {"source", estimated->source},
                      {"version", estimated->version}});
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
      fmt::format("disparity of {} view{}, {:.4g} % of the pixels, {} in the center view{}",
                  truth.views, truth.views == "all" ? "s" : "", truth.valid_percent,
                  range_text(truth.center),
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
