// SPDX-License-Identifier: BSD-3-Clause
#include "app/cli/arguments.h"
#include "app/cli/output.h"
#include "app/cli/parameter_options.h"
#include "app/cli/verbs/verbs.h"
#include "engine/disparity/registry.h"
#include "engine/io/base/json.h"

#include <nlohmann/json.hpp>

#include <iostream>

namespace episcope::cli {
namespace {

Json parameter_json(const ParameterDescription& parameter) {
  Json json;
  json["key"] = parameter.key;
  json["label"] = parameter.label;
  json["help"] = parameter.help;
  json["unit"] = parameter.unit;
  json["default"] = value_json(parameter.default_value);
  if (!parameter.choices.empty()) json["choices"] = parameter.choices;
  for (const Preset& preset : parameter.presets) {
    json["presets"][preset.choice] = io::parameters_json(preset.values);
  }
  if (has_numeric_domain(parameter)) {
    json["min"] = parameter.min;
    json["max"] = parameter.max;
  }
  return json;
}

Json method_json(const Estimator& method) {
  Json json;
  json["id"] = method.info.id;
  json["name"] = method.info.name;
  json["summary"] = method.info.summary;
  json["reference"] = method.info.reference;
  json["all_views"] = method.info.all_views;
  json["parameters"] = Json::array();
  for (const auto& parameter : method.parameters) {
    json["parameters"].push_back(parameter_json(parameter));
  }
  return json;
}

void print_method(const Estimator& method) {
  std::cout << method.info.id << "  " << method.info.name << ": " << method.info.summary << "\n  "
            << method.info.reference << (method.info.all_views ? "; all views" : "; one view")
            << '\n';
  for (const auto& parameter : method.parameters) {
    std::cout << "    --" << parameter.key << "  " << parameter.help << " ("
              << domain_text(parameter) << "; default " << to_text(parameter.default_value)
              << ")\n";
  }
  std::cout << '\n';
}

}  // namespace

void run_methods(const VerbArguments& arguments, std::stop_token) {
  bool is_json = false;
  Arguments parser("methods",
                   {"Lists every estimator with its parameters.", "episcope-cli methods --json"});
  parser.flag("--json", is_json, "Print one JSON object instead of a table");
  if (!parser.parse(arguments)) return;
  Json list = Json::array();
  for (const auto& method : registered_estimators()) {
    if (is_json) {
      list.push_back(method_json(method));
    } else {
      print_method(method);
    }
  }
  if (is_json) print_json(Json::object({{"methods", list}}));
}

}  // namespace episcope::cli
