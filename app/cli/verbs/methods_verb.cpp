// SPDX-License-Identifier: BSD-3-Clause
#include "app/cli/arguments.h"
#include "app/cli/output.h"
#include "app/cli/parameter_options.h"
#include "app/cli/verbs/verbs.h"
#include "app/session/command_line.h"
#include "engine/disparity/registry.h"

#include <nlohmann/json.hpp>

#include <iostream>

namespace episcope::cli {
namespace {

std::string weights_text(const std::string& name) {
  const Json json = weights_json(name);
  if (json.contains("problem")) return json["problem"].get<std::string>();
  const auto text_of = [&](const char* key) {
    return json[key].is_string() ? json[key].get<std::string>() : json[key].dump();
  };
  return "version " + text_of("version") + " of " + text_of("date") + ", SHA-256 " +
         text_of("sha256") + ", " + text_of("file");
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
