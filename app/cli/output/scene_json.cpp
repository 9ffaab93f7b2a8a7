// SPDX-License-Identifier: BSD-3-Clause
#include "app/cli/output/scene_json.h"

#include "app/session/scene/scene_summary.h"

namespace episcope::cli {
namespace {

void add_camera(Json& json, const LightFieldInfo& info) {
  if (const auto& camera = info.camera; camera.is_known()) {
    json["camera"] = Json::object({{"baseline", camera.baseline},
                                   {"focal_length", camera.focal_length},
                                   {"shift", camera.shift}});
    if (camera.cam_distance) json["camera"]["cam_distance"] = *camera.cam_distance;
  }
}

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

}  // namespace

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
  add_camera(json, light_field.info());
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
  return json;
}

}  // namespace episcope::cli
