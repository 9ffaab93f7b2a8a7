// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/text/text_table.h"
#include "engine/evaluation/tables/benchmark_result.h"
#include "engine/evaluation/tables/ranking.h"

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace episcope {

/// Digits after the point in tables; equal digits are a tie.
inline constexpr int kScoreDigits = 3;

/// A score as tables show it; "–" if there is none.
[[nodiscard]] std::string score_text(const std::optional<double>& score);

/// A table with its title and explanations.
struct TitledTable {
  std::string title;
  std::string note;  ///< Sentences; may be empty.
  TextTable table;
  std::vector<std::pair<std::size_t, std::size_t>> best;  ///< Cells to stress: row, column.
};

/// Scores by one metric of `metrics`, a member like &BenchmarkResult::labels. Entries and scenes
/// stand in the order of their first result.
[[nodiscard]] ScoreMatrix score_matrix(const std::vector<BenchmarkResult>& results,
                                       Metrics BenchmarkResult::*metrics, const std::string& key);
/// Of the metrics of a protocol.
[[nodiscard]] ScoreMatrix score_matrix(const std::vector<BenchmarkResult>& results,
                                       Protocol protocol, const std::string& key);

/// As figure 7 of the paper: one line per scene, one column per entry, best entry first; then
/// average and rank, and between them, if averages omit scenes, the average over all scenes that an
/// entry has, with their number. Gaps are "–"; the note says which scenes the averages omit and
/// why. The best score of each line is highlighted. Entries and scenes without any score are
/// omitted.
[[nodiscard]] TitledTable accuracy_table(const std::string& title, const ScoreMatrix& matrix);

/// As figure 8: rank, algorithm, average MSE × 100, speed class by the mean time of its scenes,
/// whether that is the time of all views.
[[nodiscard]] TitledTable overview_table(const std::vector<BenchmarkResult>& results);

/// All tables of a benchmark without search: figures 7 and 8, MSE and BadPix of the 2016 protocol,
/// official and in the resolution of the views, both layers of scenes that have two. Tables without
/// any score are left out.
[[nodiscard]] std::vector<TitledTable> benchmark_tables(
    const std::vector<BenchmarkResult>& results);

/// One line per result with every metric: "entry", "scene", "protocol.metric", …, for other
/// programs.
[[nodiscard]] TextTable results_table(const std::vector<BenchmarkResult>& results);

}  // namespace episcope
