// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/evaluation/tables/benchmark_tables.h"
#include "engine/evaluation/tables/parameter_search.h"

namespace episcope {

/// The search of one method, gathered.
struct MethodSearch {
  std::string method;
  std::vector<std::string> scenes;
  std::vector<ParameterSet> points;  ///< The first is the default.
  SearchScores scores;               ///< [point][scene], MSE × 100.
  ParameterChoice choice;
};

/// One for each method, all over the same scenes, in the order of first results.
[[nodiscard]] std::vector<MethodSearch> gather_searches(const std::vector<SearchResult>& results);

/// "lambda 0.1, edge_strength 30"; "default" if nothing is searched.
[[nodiscard]] std::string point_text(const ParameterSet& point);

/// First the averages of every method under each protocol: the best point of each scene (P-opt, as
/// figure 7), equal parameters for all scenes (P-fix), the same chosen without the scene that is
/// judged (LOSO), and the default; ranked by P-opt. Then for each method the scenes with scores and
/// points. Empty without results.
[[nodiscard]] std::vector<TitledTable> search_tables(const std::vector<SearchResult>& results);

}  // namespace episcope
