// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/models/estimated.h"

#include "engine/io/base/json.h"

#include <nlohmann/json.hpp>

namespace episcope::io {

void write_estimated(Hdf5Output& file, const std::string& map, const Provenance& estimated) {
  file.set_text(map, kEstimatedBy, estimated.method);
  file.set_text(map, kEstimateParameters, parameters_to_json(estimated.parameters));
  file.set_text(map, kEstimateSource, estimated.source);
  if (!estimated.version.empty()) file.set_text(map, kEstimateVersion, estimated.version);
}

std::optional<Provenance> estimated_in(const Hdf5Input& file, const std::string& map) {
  const auto method = file.text(map, kEstimatedBy);
  if (!method) return std::nullopt;
  Provenance estimated;
  estimated.method = *method;
  estimated.parameters = parameters_from_json(file.text(map, kEstimateParameters).value_or("{}"));
  estimated.source = file.text(map, kEstimateSource).value_or("");
  estimated.version = file.text(map, kEstimateVersion).value_or("");
  return estimated;
}

std::string estimated_json(const Provenance& estimated) {
  return json_text(
      nlohmann::ordered_json{{kEstimatedBy, estimated.method},
                             {kEstimateParameters, parameters_json(estimated.parameters)},
                             {kEstimateSource, estimated.source},
                             {kEstimateVersion, estimated.version}});
}

std::optional<Provenance> estimated_from_json(const std::string& text) {
  const auto json = json_or_null<nlohmann::ordered_json>(text);
  const auto text_of = [&](const char* key) {
    const bool is_text = json.is_object() && json.contains(key) && json[key].is_string();
    return is_text ? json[key].get<std::string>() : std::string();
  };
  Provenance estimated;
  estimated.method = text_of(kEstimatedBy);
  if (estimated.method.empty()) return std::nullopt;
  if (json.contains(kEstimateParameters)) {
    estimated.parameters = parameters_from(json[kEstimateParameters]);
  }
  estimated.source = text_of(kEstimateSource);
  estimated.version = text_of(kEstimateVersion);
  return estimated;
}

}  // namespace episcope::io
