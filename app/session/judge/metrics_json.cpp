// SPDX-License-Identifier: BSD-3-Clause
#include "app/session/judge/metrics_json.h"

#include <nlohmann/json.hpp>

namespace episcope {

nlohmann::ordered_json metrics_json(const Metrics& metrics) {
  auto object = nlohmann::ordered_json::object();
  for (const auto& [key, value] : metrics) object[key] = value;
  return object;
}

Metrics metrics_from(const nlohmann::ordered_json& object) {
  Metrics metrics;
  for (const auto& [key, value] : object.items()) {
    if (value.is_number()) metrics.emplace_back(key, value.get<double>());
  }
  return metrics;
}

}  // namespace episcope
