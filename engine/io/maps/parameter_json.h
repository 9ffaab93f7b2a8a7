// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/parameter/parameter.h"

#include <nlohmann/json_fwd.hpp>

#include <string>

namespace episcope::io {

/// Object of parameter values by key, in their order, as in result files and projects: booleans,
/// whole and real numbers, strings, intervals and views `[a, b]`, null for "auto".
[[nodiscard]] nlohmann::ordered_json parameters_json(const ParameterSet& parameters);
/// Its text on one line; bytes that are not UTF-8 become the replacement character.
[[nodiscard]] std::string parameters_to_json(const ParameterSet& parameters);

/// Reads what `parameters_json` made. Anything else, as foreign files may hold, is kept as its JSON
/// text; what is no JSON object gives an empty set.
[[nodiscard]] ParameterSet parameters_from(const nlohmann::ordered_json& object);
[[nodiscard]] ParameterSet parameters_from_json(const std::string& json);

}  // namespace episcope::io
