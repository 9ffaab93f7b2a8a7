// SPDX-License-Identifier: BSD-3-Clause
#include "app/cli/parameter_options.h"

#include "app/cli/arguments.h"
#include "app/session/command_line.h"
#include "engine/core/error.h"
#include "engine/core/text.h"
#include "engine/disparity/registry.h"

namespace episcope::cli {
namespace {

/// Values of this type, read as options of that type are everywhere.
template <class T>
OptionValue<ParameterValue> as_parameter(const OptionValue<T>& typed) {
  return {typed.name,
          [read = typed.read](const std::string& option, const std::string& text) {
            return ParameterValue(read(option, text));
          },
          typed.choices};
}

std::vector<std::string> words_of(const ParameterDescription& parameter) {
  if (std::holds_alternative<bool>(parameter.default_value)) return {"true", "false"};
  return {};
}

/// Values that have a word beside their numbers, such as "auto".
OptionValue<ParameterValue> described_value(const ParameterDescription& parameter) {
  return {domain_text(parameter),
          [parameter](const std::string& option, const std::string& text) {
            try {
              return parse_parameter(parameter, text);
            } catch (const InvalidInput& error) {
              const std::string sentence = error.what();
              const std::string subject = "parameter " + parameter.key;
              if (!sentence.starts_with(subject)) throw UsageError(sentence);
              throw UsageError(option + sentence.substr(subject.size()));
            }
          },
          words_of(parameter)};
}

OptionValue<ParameterValue> value_of(const ParameterDescription& parameter) {
  const std::string name = domain_text(parameter);
  if (!parameter.choices.empty()) return as_parameter(one_of(parameter.choices));
  if (std::holds_alternative<int>(parameter.default_value)) {
    return as_parameter(
        integer_value(name, static_cast<int>(parameter.min), static_cast<int>(parameter.max)));
  }
  if (std::holds_alternative<double>(parameter.default_value)) {
    return as_parameter(real_value(name, parameter.min, parameter.max));
  }
  return described_value(parameter);
}

/// With the default, unless the help tells it.
std::string help_text(const ParameterDescription& parameter) {
  const std::string preset = to_text(parameter.default_value);
  const bool is_told = preset.empty() || parameter.help.find("by default") != std::string::npos;
  const std::string others = presets_text(parameter);
  return parameter.help + (others.empty() ? "" : "; " + others) +
         (is_told ? "" : " (default " + preset + ")");
}

}  // namespace

void ParameterOptions::declare(Arguments& arguments,
                               const std::vector<ParameterDescription>& parameters,
                               const std::map<std::string, std::string>& names) {
  for (const auto& parameter : parameters) {
    keys_.push_back(parameter.key);
    const std::string by_key = "--" + option_name(parameter.key);
    const auto other = names.find(parameter.key);
    const std::string name = other == names.end() ? by_key : other->second;
    if (name != by_key) arguments.earlier_name(by_key, name);
    std::optional<ParameterValue>& value = values_[parameter.key];
    if (parameter.is_toggle) {
      arguments.flag(name, value, std::optional<ParameterValue>(true), parameter.help);
    } else {
      arguments.option(name, value, value_of(parameter), help_text(parameter));
    }
  }
}

ParameterSet ParameterOptions::values() const {
  ParameterSet set;
  for (const std::string& key : keys_) {
    if (const auto& value = values_.at(key)) set.emplace_back(key, *value);
  }
  return set;
}

bool ParameterOptions::is_given(const std::string& key) const {
  const auto found = values_.find(key);
  return found != values_.end() && found->second.has_value();
}

std::string domain_text(const ParameterDescription& parameter) {
  if (std::holds_alternative<bool>(parameter.default_value)) return "true|false";
  if (!parameter.choices.empty()) return joined(parameter.choices, "|");
  if (std::holds_alternative<ViewOrAuto>(parameter.default_value)) return "auto|V,U";
  if (!has_numeric_domain(parameter)) return "TEXT";
  const std::string ends = to_text(parameter.min) + " … " + to_text(parameter.max) +
                           (parameter.unit.empty() ? "" : " " + parameter.unit);
  return std::holds_alternative<IntervalOrAuto>(parameter.default_value)
             ? "auto, found or A,B in " + ends
             : ends;
}

std::vector<Estimator> methods_named(const std::vector<std::string>& ids) {
  std::vector<Estimator> methods;
  for (const std::string& id : ids) {
    const Estimator* const known = known_estimator(id);
    if (known == nullptr) throw unknown_name("method", id, estimator_ids());
    const auto is_same = [&](const Estimator& each) { return each.info.id == known->info.id; };
    if (std::ranges::none_of(methods, is_same)) methods.push_back(*known);
  }
  return methods;
}

}  // namespace episcope::cli
