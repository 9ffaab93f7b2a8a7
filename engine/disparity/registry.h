// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/disparity/estimator.h"

#include <string>
#include <vector>

namespace episcope {

/// Every estimator of this build, in the order of lists; made once, and there until the program
/// ends.
[[nodiscard]] const std::vector<Estimator>& registered_estimators();

/// The estimator of that id, in any case: "epi_l", "EPI_L" as it is displayed; null if this build
/// has none.
[[nodiscard]] const Estimator* known_estimator(const std::string& id);
/// The ids of all estimators.
[[nodiscard]] std::vector<std::string> estimator_ids();
/// Throws Unavailable for an unknown id, naming the nearest.
[[nodiscard]] const Estimator& find_estimator(const std::string& id);

}  // namespace episcope
