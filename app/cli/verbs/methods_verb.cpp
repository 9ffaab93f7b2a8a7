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
  if (is_json) return print_json(Json::object({{"methods", methods_json()}}));
  for (const auto& method : registered_estimators()) print_method(method);
}

}  // namespace episcope::cli
