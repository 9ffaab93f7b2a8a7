// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/session/project/project.h"

#include <nlohmann/json_fwd.hpp>

#include <vector>

namespace episcope {

/// The sweeps of a project: what was asked for, and the numbers of the points. Maps are not part of
/// it: they are computed again when they are looked at.
[[nodiscard]] nlohmann::ordered_json sweeps_json(const Project& project);

/// Reads them. Those of methods or parameters that this program does not know are left out, as are
/// light fields that are not among `scenes`. Throws nlohmann::json::exception and InvalidInput for
/// what is no list of sweeps.
[[nodiscard]] std::vector<Sweep> sweeps_of(const nlohmann::ordered_json& json,
                                           const std::vector<ProjectScene>& scenes);

}  // namespace episcope
