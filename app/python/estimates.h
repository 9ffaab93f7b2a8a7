// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/python/light_fields.h"
#include "engine/core/estimate.h"
#include "engine/disparity/estimator.h"

#include <string>

namespace episcope::python {

/// How a file that is there is replaced.
inline constexpr const char* kByArgument = "pass overwrite=True";

/// A result as Python sees it. Immutable but for what is kept of arrays that took a copy.
struct FoundEstimate {
  EstimatePtr estimate;
  OpenedScene of;          ///< The light field that it is of.
  py::object disparity{};  ///< Its array, once it was asked for.
};

/// Options of a run from what Python calls them. Throws InvalidInput for an unknown device.
[[nodiscard]] RunOptions run_options(const std::string& device, int threads);

/// Adds the class Result, and `estimate`, `score`, `methods`.
void add_estimates(py::module_& module);

}  // namespace episcope::python
