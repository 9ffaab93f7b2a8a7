// SPDX-License-Identifier: BSD-3-Clause
#include "app/cli/arguments.h"
#include "app/cli/output.h"
#include "app/cli/parameter_options.h"
#include "app/cli/verbs/verbs.h"
#include "engine/disparity/registry.h"
#include "engine/disparity/weights_file.h"
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

/// What the record of a learned method's weights says, or why they cannot be read.
Json weights_json(const std::string& name) {
  Json json;
  json["file"] = name;
  try {
    const auto path = installed_weights(name);
    json["file"] = path.string();
    const auto record = io::parse_json<Json>(read_named_arrays(path).record);
    json["version"] = record.at("version");
    json["date"] = record.at("training").at("date");
    json["sha256"] = record.at("sha256");
  } catch (const Error& error) {
    json["problem"] = error.what();
  } catch (const Json::exception&) {
    json["problem"] = "their record is damaged; install the program anew";
  }
  return json;
}

std::string weights_text(const std::string& name) {
  const Json json = weights_json(name);
  if (json.contains("problem")) return json["problem"].get<std::string>();
  const auto text_of = [&](const char* key) {
    return json[key].is_string() ? json[key].get<std::string>() : json[key].dump();
  };
  return "version " + text_of("version") + " of " + text_of("date") + ", SHA-256 " +
         text_of("sha256") + ", " + text_of("file");
}

Json method_json(const Estimator& method) {
  Json json;
  json["id"] = method.info.id;
  json["name"] = method.info.name;
  json["summary"] = method.info.summary;
  json["reference"] = method.info.reference;
  json["all_views"] = method.info.all_views;
  if (!method.info.weights.empty()) json["weights"] = weights_json(method.info.weights);
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
  if (!method.info.weights.empty()) {
    std::cout << "  weights: " << weights_text(method.info.weights) << '\n';
  }
  for (const auto& parameter : method.parameters) {
    std::cout << "    --" << parameter.key << "  " << parameter.help << " ("
              << domain_text(parameter) << "; default " << to_text(parameter.default_value)
              << ")\n";
  }
  std::cout << '\n';
}

/// Those of these ids, or all without any.
std::vector<const Estimator*> methods_named(const std::vector<std::string>& ids) {
  std::vector<const Estimator*> methods;
  for (const std::string& id : ids) {
    methods.push_back(known_estimator(id));
    if (!methods.back()) throw unknown_name("method", id, estimator_ids());
  }
  if (!ids.empty()) return methods;
  for (const Estimator& method : registered_estimators()) methods.push_back(&method);
  return methods;
}

}  // namespace

void run_methods(const VerbArguments& arguments, std::stop_token) {
  bool is_json = false;
  std::vector<std::string> ids;
  Arguments parser("methods", {"Lists every estimator with its parameters; of a learned one also "
                               "its weights.",
                               "episcope-cli methods --json\n  episcope-cli methods net"});
  parser.optional_positionals("METHOD", ids, "Only the estimators of these ids");
  parser.flag("--json", is_json, "Print one JSON object instead of a table");
  if (!parser.parse(arguments)) return;
  Json list = Json::array();
  for (const Estimator* method : methods_named(ids)) {
    if (is_json) {
      list.push_back(method_json(*method));
    } else {
      print_method(*method);
    }
  }
  if (is_json) print_json(Json::object({{"methods", list}}));
}

}  // namespace episcope::cli
