// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/benchmark/report/report.h"

#include <string>

namespace episcope {

/// One JSON object: "program", "version", "scenes", "ranking" (entry, rank, average MSE × 100,
/// scenes averaged over), of labels "label_ranking" (likewise, by accuracy), "results" (every
/// metric of both protocols, "labels"; what is not known is absent;
/// "figure_7" where the paper has scene and entry), and of a search "search": by method the points
/// with their scores by scene, P-opt, P-fix, LOSO.
[[nodiscard]] std::string report_to_json(const BenchmarkReport& report);

}  // namespace episcope
