// SPDX-License-Identifier: BSD-3-Clause
#include "app/session/command_line.h"

#include "engine/core/error.h"
#include "engine/disparity/net_weights.h"
#include "engine/disparity/registry.h"
#include "engine/io/base/json.h"
#include "engine/io/models/open_options.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cctype>

namespace episcope {
namespace {

// As texts: files tell one "auto" from another no more.
bool is_default(const std::vector<ParameterDescription>& descriptions, const std::string& key,
                const ParameterValue& value) {
  return std::any_of(
      descriptions.begin(), descriptions.end(), [&](const ParameterDescription& description) {
        return description.key == key && to_text(description.default_value) == to_text(value);
      });
}

using Json = nlohmann::ordered_json;

Json parameter_json(const ParameterDescription& parameter) {
  Json json;
  json["key"] = parameter.key;
  json["label"] = parameter.label;
  json["help"] = parameter.help;
  json["unit"] = parameter.unit;
  json["default"] = io::parameters_json({{"", parameter.default_value}}).at("");
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

}  // namespace

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

std::string shell_quoted(const std::string& word) {
  const auto is_plain = [](char c) {
    const auto code = static_cast<unsigned char>(c);
    return std::isalnum(code) || code >= 0x80 ||
           std::string("_-./:,+=@%").find(c) != std::string::npos;
  };
  if (!word.empty() && std::all_of(word.begin(), word.end(), is_plain)) return word;
  std::string quoted = "'";
  for (const char c : word) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

ParameterSet changed_parameters(const std::string& method, const ParameterSet& values) {
  std::vector<ParameterDescription> descriptions;
  if (const Estimator* known = known_estimator(method)) {
    descriptions = described_under(known->parameters, values);
  }
  ParameterSet changed;
  for (const auto& [key, value] : values) {
    if (!is_default(descriptions, key, value)) changed.emplace_back(key, value);
  }
  return changed;
}

std::string option_name(std::string key) {
  std::ranges::replace(key, '_', '-');
  return key;
}

std::string options_text(const ParameterSet& options,
                         const std::vector<ParameterDescription>& descriptions) {
  std::string text;
  for (const auto& [key, value] : options) {
    const auto found = std::ranges::find(descriptions, key, &ParameterDescription::key);
    const bool is_bare =
        found != descriptions.end() && found->is_toggle && value == ParameterValue(true);
    // "=" keeps a value that begins with a minus from being read as an option.
    text += " --" + option_name(key);
    if (!is_bare) text += "=" + shell_quoted(to_text(value));
  }
  return text;
}

std::string reading_options_text(const ParameterSet& options) {
  return options_text(options, io::open_schema().descriptions());
}

std::string command_line_for(const std::string& method, const ParameterSet& values,
                             ViewSelection views, const std::string& input,
                             const ParameterSet& reading) {
  const std::string line =
      fmt::format("episcope-cli estimate {} {} -o {} --views {}", shell_quoted(method),
                  shell_quoted(input), shell_quoted(method + ".h5"), name_of(views));
  return line + options_text(changed_parameters(method, values), {}) +
         reading_options_text(reading);
}

std::string command_line_for(const Estimate& estimate, const std::string& input,
                             const ParameterSet& reading) {
  const bool is_one_view = estimate.field.disparity.grid().count() == 1;
  return command_line_for(estimate.method, estimate.parameters,
                          is_one_view ? ViewSelection::Center : ViewSelection::All, input, reading);
}

}  // namespace episcope
