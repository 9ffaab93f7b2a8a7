// SPDX-License-Identifier: BSD-3-Clause
#include "app/cli/arguments/parameter_options.h"

#include "app/cli/arguments/arguments.h"
#include "app/cli/arguments/usage_error.h"

namespace episcope::cli {

void ParameterOptions::declare(Arguments& arguments, const std::string& heading,
                               const std::vector<ParameterDescription>& parameters) {
  arguments.heading(heading);
  for (const auto& parameter : parameters) {
    parameters_.push_back(parameter);
    if (parameter.is_toggle) {
      arguments.flag("--" + parameter.key, toggles_[parameter.key], parameter.help);
      continue;
    }
    const std::string preset = to_text(parameter.default_value);
    arguments.option("--" + parameter.key, texts_[parameter.key], domain_text(parameter),
                     parameter.help + (preset.empty() ? "" : " (default " + preset + ")"));
  }
}

ParameterSet ParameterOptions::values() const {
  ParameterSet set;
  for (const auto& parameter : parameters_) {
    if (parameter.is_toggle) {
      if (toggles_.at(parameter.key)) set.emplace_back(parameter.key, true);
      continue;
    }
    const std::string& text = texts_.at(parameter.key);
    if (text.empty()) continue;
    try {
      set.emplace_back(parameter.key, parse_parameter(parameter, text));
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
