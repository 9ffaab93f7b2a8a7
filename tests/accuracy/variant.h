// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/disparity/estimator.h"

#include <string>
#include <vector>

namespace episcope::accuracy {

/// A method with values over its defaults.
struct Variant {
  Estimator estimator;
  ParameterSet values;
};

/// The methods of these ids; of an empty list all. `settings` are "key=value" for every method that
/// has the parameter, or "method.key=value" for one. Throws Unavailable for an unknown method and
/// InvalidInput for a setting that no method takes or whose value is out of its domain.
[[nodiscard]] std::vector<Variant> variants(const std::vector<std::string>& methods,
                                            const std::vector<std::string>& settings);

}  // namespace episcope::accuracy
