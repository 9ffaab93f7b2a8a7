// SPDX-License-Identifier: BSD-3-Clause
#include "tests/accuracy/variant.h"

#include "engine/core/error.h"
#include "engine/disparity/registry.h"

#include <fmt/format.h>

#include <algorithm>

namespace episcope::accuracy {
namespace {

struct Setting {
  std::string method;  // Empty: all that have the parameter.
  std::string key;
  std::string value;
};

Setting parse(const std::string& text) {
  const auto equals = text.find('=');
  if (equals == text.npos) {
    throw InvalidInput(fmt::format("cannot set '{}': write key=value or method.key=value", text));
  }
  const std::string name = text.substr(0, equals);
  const auto dot = name.find('.');
  if (dot == name.npos) return {{}, name, text.substr(equals + 1)};
  return {name.substr(0, dot), name.substr(dot + 1), text.substr(equals + 1)};
}

// Whether any method took it.
bool give(const Setting& setting, std::vector<Variant>& variants) {
  bool was_taken = false;
  for (Variant& variant : variants) {
    if (!setting.method.empty() && setting.method != variant.estimator.info.id) continue;
    const auto& parameters = variant.estimator.parameters;
    const auto found = std::ranges::find(parameters, setting.key, &ParameterDescription::key);
    if (found == parameters.end()) continue;
    variant.values.emplace_back(setting.key, parse_parameter(*found, setting.value));
    was_taken = true;
  }
  return was_taken;
}

}  // namespace

std::vector<Variant> variants(const std::vector<std::string>& methods,
                              const std::vector<std::string>& settings) {
  std::vector<Variant> variants;
  if (methods.empty()) {
    for (const Estimator& estimator : registered_estimators()) variants.push_back({estimator, {}});
  }
  for (const std::string& id : methods) variants.push_back({find_estimator(id), {}});
  for (const std::string& text : settings) {
    if (!give(parse(text), variants)) {
      throw InvalidInput(fmt::format("cannot set '{}': none of the methods has it", text));
    }
  }
  return variants;
}

}  // namespace episcope::accuracy
