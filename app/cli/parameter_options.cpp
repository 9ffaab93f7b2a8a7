// SPDX-License-Identifier: BSD-3-Clause
#include "app/cli/parameter_options.h"

#include "app/cli/arguments.h"
#include "app/cli/usage_error.h"

namespace episcope::cli {

void ParameterOptions::declare(Arguments& arguments, const std::string& heading,
                               const std::vector<ParameterDescription>& parameters) {
  arguments.heading(heading);
  for (const auto& parameter : parameters) {
    arguments.option("--" + parameter.key, texts_[parameter.key], domain_text(parameter),
                     parameter.help + " (default " + to_text(parameter.default_value) + ")");
  }
}

ParameterSet ParameterOptions::values(const std::vector<ParameterDescription>& parameters) const {
  ParameterSet set;
  for (const auto& parameter : parameters) {
    const auto found = texts_.find(parameter.key);
    if (found == texts_.end() || found->second.empty()) continue;
    try {
      set.emplace_back(parameter.key, parse_parameter(parameter, found->second));
    } catch (const InvalidInput& error) {
      throw UsageError(error.what());
    }
  }
  return set;
}

bool has_numeric_domain(const ParameterDescription& parameter) {
  return !std::holds_alternative<bool>(parameter.default_value) &&
         !std::holds_alternative<std::string>(parameter.default_value) &&
         !std::holds_alternative<ViewOrAuto>(parameter.default_value);
}

std::string domain_text(const ParameterDescription& parameter) {
  if (std::holds_alternative<bool>(parameter.default_value)) return "true|false";
  if (!parameter.choices.empty()) {
    std::string list;
    for (const auto& choice : parameter.choices) list += (list.empty() ? "" : "|") + choice;
    return list;
  }
  if (std::holds_alternative<ViewOrAuto>(parameter.default_value)) return "auto|V,U";
  if (!has_numeric_domain(parameter)) return "TEXT";
  const std::string ends = to_text(parameter.min) + " … " + to_text(parameter.max) +
                           (parameter.unit.empty() ? "" : " " + parameter.unit);
  return std::holds_alternative<IntervalOrAuto>(parameter.default_value) ? "auto or A,B in " + ends
                                                                         : ends;
}

}  // namespace episcope::cli
