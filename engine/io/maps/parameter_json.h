// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/parameter/parameter.h"

#include <string>

namespace episcope::io {

/// Reads what `parameters_to_json` wrote: booleans, whole and real numbers, strings, intervals
/// `[a, b]`, null for "auto" and "found". Anything else, as foreign files may hold, is kept as its
/// JSON text; text that is no JSON object gives an empty set.
[[nodiscard]] ParameterSet parameters_from_json(const std::string& json);

}  // namespace episcope::io
