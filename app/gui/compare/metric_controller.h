// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/gui/shell/jobs.h"
#include "app/gui/shell/workbench.h"
#include "app/session/session.h"
#include "engine/evaluation/metrics.h"
#include "engine/evaluation/resolved_errors.h"
#include "widgets/panels/metric_table.h"

#include <map>
#include <set>
#include <string>
#include <vector>

namespace episcope {

/// A result with its known scores.
struct Judged {
  int id = 0;
  std::string name;
  double seconds = 0;
  std::map<Protocol, Metrics> metrics;
  std::map<Protocol, std::size_t> pixels{};  ///< Evaluated pixels; empty for the whole view.
};

/// Header, tool tip and decimals of a metric, by its key in engine/evaluation.
[[nodiscard]] MetricColumn metric_column(Protocol protocol, const std::string& key);

/// Rank of a metric in tables: the most important first, independent of the protocol.
[[nodiscard]] int metric_rank(const std::string& key);

}  // namespace episcope
