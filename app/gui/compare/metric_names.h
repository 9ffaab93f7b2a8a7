// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/evaluation/metrics/metrics.h"
#include "widgets/compare/metric_table.h"

#include <string>

namespace episcope {

/// Header, tool tip and decimals of a metric, by its key in engine/evaluation.
[[nodiscard]] MetricColumn metric_column(Protocol protocol, const std::string& key);

/// Position of a metric in tables: the most important first, whatever the protocol.
[[nodiscard]] int metric_rank(const std::string& key);

}  // namespace episcope
