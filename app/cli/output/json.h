// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/array/indices.h"
#include "engine/core/parameter/parameter.h"

#include <nlohmann/json.hpp>

namespace episcope::cli {

/// JSON answers keep the order in which their keys were added. Only verbs include this header.
using Json = nlohmann::ordered_json;

/// "auto" for an interval that is not set, else [A, B].
[[nodiscard]] Json value_json(const ParameterValue& value);
[[nodiscard]] Json interval_json(const Interval& interval);
/// The one JSON object of an answer, on standard output.
void print_json(const Json& json);

}  // namespace episcope::cli
