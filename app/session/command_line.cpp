// SPDX-License-Identifier: BSD-3-Clause
#include "app/session/command_line.h"

#include "engine/disparity/registry.h"

#include <algorithm>
#include <cctype>

namespace episcope {
namespace {

const Estimator* find(const std::vector<Estimator>& estimators, const std::string& id) {
  const auto found = std::find_if(estimators.begin(), estimators.end(),
                                  [&](const Estimator& each) { return each.info.id == id; });
  return found == estimators.end() ? nullptr : &*found;
}

bool is_default(const Estimator& estimator, const std::string& key, const ParameterValue& value) {
  return std::any_of(estimator.parameters.begin(), estimator.parameters.end(),
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

std::string command_line_for(const std::string& method, const ParameterSet& values,
                             ViewSelection views, const std::string& input) {
  const std::vector<Estimator> estimators = registered_estimators();
  const Estimator* estimator = find(estimators, method);
  std::string line = "episcope-cli estimate " + shell_quoted(method) + " " + shell_quoted(input) +
                     " -o " + shell_quoted(method + ".h5") + " --views " +
                     (views == ViewSelection::All ? "all" : "center");
  for (const auto& [key, value] : values) {
    if (estimator && is_default(*estimator, key, value)) continue;
    // "=" keeps a value that begins with a minus from being read as an option.
    line += " --" + key + "=" + shell_quoted(to_text(value));
  }
  return line;
}

std::string command_line_for(const Estimate& estimate, const std::string& input) {
  const bool is_one_view = estimate.field.disparity.grid().count() == 1;
  return command_line_for(estimate.method, estimate.parameters,
                          is_one_view ? ViewSelection::Center : ViewSelection::All, input);
}

}  // namespace episcope
