// SPDX-License-Identifier: BSD-3-Clause
#include "app/cli/arguments.h"
#include "app/cli/output.h"
#include "app/cli/parameter_options.h"
#include "app/cli/verbs/verbs.h"
#include "app/session/command_line.h"
#include "engine/disparity/registry.h"
#include "engine/io/base/json.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <iostream>
#include <string>
#include <vector>

namespace episcope::cli {
namespace {

std::string weights_text(const std::string& name) {
  const Json json = weights_json(name);
  if (json.contains("problem")) return json["problem"].get<std::string>();
  const auto text_of = [&](const char* key) {
    return json[key].is_string() ? json[key].get<std::string>() : io::json_text(json[key]);
  };
  return "version " + text_of("version") + " of " + text_of("date") + ", SHA-256 " +
         text_of("sha256") + ", " + text_of("file");
}

bool has_gpu(const Estimator& method) {
  return std::ranges::count(method.info.devices, Device::Cuda) > 0;
}

void print_method(const Estimator& method) {
  std::cout << method.info.id << "  " << method.info.name << ": " << method.info.summary << "\n  "
            << method.info.reference << (method.info.all_views ? "; all views" : "; one view")
            << (has_gpu(method) ? "; CPU, GPU" : "; CPU") << '\n';
  if (!method.info.weights.empty()) {
    std::cout << "  weights: " << weights_text(method.info.weights) << '\n';
  }
  for (const auto& parameter : method.parameters) {
    std::cout << "    --" << option_name(parameter.key) << "  " << parameter.help << " ("
              << domain_text(parameter) << "; default " << to_text(parameter.default_value)
              << ")\n";
  }
}

/// A line for each.
void print_table(const std::vector<Estimator>& methods) {
  std::size_t longest = 0;
  for (const Estimator& each : methods) longest = std::max(longest, each.info.id.size());
  for (const Estimator& each : methods) {
    std::cout << fmt::format("{:<{}}  {:<{}}  {}  {}  {}\n", each.info.id, longest, each.info.name,
                             longest, each.info.all_views ? "all views" : "one view ",
                             has_gpu(each) ? "CPU, GPU" : "CPU     ", each.info.summary);
  }
  std::cout << "\n'episcope-cli methods ID' tells reference and parameters, such as --range.\n";
}

}  // namespace

void run_methods(const VerbArguments& arguments, std::stop_token) {
  bool is_json = false;
  std::vector<std::string> names;
  Arguments parser("methods",
                   {"Lists every estimator in a line, or those that are named with reference and\n"
                    "parameters, and of a learned one its weights. Ids are read in any case.",
                    "episcope-cli methods net\n"
                    "  episcope-cli methods --json"});
  parser.optional_positionals("ID", names, "Methods to tell all of");
  parser.flag("--json", is_json, "Print one JSON object instead of a table");
  if (!parser.parse(arguments)) return;
  const std::vector<Estimator> methods =
      names.empty() ? registered_estimators() : methods_named(names);
  if (is_json) {
    Json list = Json::array();
    for (const Estimator& each : methods) list.push_back(method_json(each));
    return print_answer(Json::object({{"methods", list}, {"results", list}}));
  }
  if (names.empty()) return print_table(methods);
  for (const Estimator& each : methods) print_method(each);
}

}  // namespace episcope::cli
