// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/evaluation/metrics/metrics.h"

#include <nlohmann/json_fwd.hpp>

namespace episcope {

/// Object of metrics by key, in their order; NaN becomes null when it is written.
[[nodiscard]] nlohmann::ordered_json metrics_json(const Metrics& metrics);
/// Reads what `metrics_json` made; what is no number is left out.
[[nodiscard]] Metrics metrics_from(const nlohmann::ordered_json& object);

}  // namespace episcope
