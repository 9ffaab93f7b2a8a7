// SPDX-License-Identifier: BSD-3-Clause
#include "app/session/command_line.h"

#include "engine/disparity/registry.h"

#include <algorithm>
#include <array>
#include <cctype>

namespace episcope {
namespace {

bool is_default(const std::vector<ParameterDescription>& descriptions, const std::string& key,
                const ParameterValue& value) {
  return std::any_of(descriptions.begin(), descriptions.end(),
                     [&](const ParameterDescription& description) {
                       return description.key == key && description.default_value == value;
                     });
}

}  // namespace

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
  for (const Estimator& estimator : registered_estimators()) {
    if (estimator.info.id == method) descriptions = estimator.parameters;
  }
  ParameterSet changed;
  for (const auto& [key, value] : values) {
    if (!is_default(descriptions, key, value)) changed.emplace_back(key, value);
  }
  return changed;
}

std::string reading_options(const io::OpenOptions& conventions) {
  // In the order of the enumerations.
  constexpr std::array flips = {"auto", "none", "u", "v", "both"};
  constexpr std::array units = {"auto", "with-width", "without-width"};
  std::string options;
  if (conventions.flip != io::OpenOptions::Flip::Auto) {
    options += std::string(" --flip=") + flips[static_cast<std::size_t>(conventions.flip)];
  }
  if (conventions.units != io::OpenOptions::Units::Auto) {
    options += std::string(" --units=") + units[static_cast<std::size_t>(conventions.units)];
  }
  if (!conventions.pattern.empty()) options += " --pattern=" + shell_quoted(conventions.pattern);
  if (conventions.snake) options += " --snake";
  if (conventions.focus_px != 0) options += " --focus=" + to_text(conventions.focus_px);
  return options;
}

std::string command_line_for(const std::string& method, const ParameterSet& values,
                             ViewSelection views, const std::string& input,
                             const io::OpenOptions& conventions) {
  std::string line = "episcope-cli estimate " + shell_quoted(method) + " " + shell_quoted(input) +
                     " -o " + shell_quoted(method + ".h5") + " --views " + name_of(views);
  for (const auto& [key, value] : changed_parameters(method, values)) {
    // "=" keeps a value that begins with a minus from being read as an option.
    line += " --" + key + "=" + shell_quoted(to_text(value));
  }
  return line + reading_options(conventions);
}

std::string command_line_for(const Estimate& estimate, const std::string& input,
                             const io::OpenOptions& conventions) {
  const bool is_one_view = estimate.field.disparity.grid().count() == 1;
  return command_line_for(estimate.method, estimate.parameters,
                          is_one_view ? ViewSelection::Center : ViewSelection::All, input,
                          conventions);
}

}  // namespace episcope
