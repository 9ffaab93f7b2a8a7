// SPDX-License-Identifier: BSD-3-Clause
#include "app/session/project/sweep_json.h"

#include "app/session/judge/metrics_json.h"
#include "app/session/sweep/sweep_values.h"
#include "engine/core/error.h"
#include "engine/disparity/registry.h"
#include "engine/io/json/bounded_json.h"
#include "engine/io/maps/parameter_json.h"

#include <nlohmann/json.hpp>

#include <algorithm>

namespace episcope {
namespace {

using Json = nlohmann::ordered_json;

Json point_json(const SweepPoint& point) {
  Json json{{"values", io::parameters_json(point.point)},
            {"seconds", point.seconds},
            {"display_range", {point.display_range.min, point.display_range.max}},
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
  point.display_range = {json.at("display_range").at(0), json.at("display_range").at(1)};
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
  const auto& methods = registered_estimators();
  const auto method = std::ranges::find(methods, sweep.base.method,
                                        [](const Estimator& each) { return each.info.id; });
  if (method == methods.end() || sweep.swept.empty() || sweep.scenes.empty()) return false;
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

}  // namespace

Json sweeps_json(const Project& project) {
  Json json = Json::array();
  for (const Sweep& each : project.sweeps) json.push_back(sweep_json(each, project.scenes));
  return json;
}

std::vector<Sweep> sweeps_of(const Json& json, const std::vector<ProjectScene>& scenes) {
  std::vector<Sweep> sweeps;
  for (const Json& each : json) {
    Sweep sweep = sweep_of(each, scenes);
    if (is_known(sweep)) sweeps.push_back(std::move(sweep));
  }
  return sweeps;
}

}  // namespace episcope
