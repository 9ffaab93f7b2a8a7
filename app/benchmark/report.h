// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/indices.h"
#include "engine/evaluation/benchmark_tables.h"

#include <filesystem>
#include <string>
#include <vector>

namespace episcope {

/// A light field of a benchmark.
struct BenchmarkScene {
  std::string name;   ///< Unique in the benchmark; names its folder below `scenes`.
  std::string input;  ///< As it was asked for.
  std::string shape;  ///< "9×9 views of 512×512 px".
  Interval range;     ///< Disparities at the ends of the color map; {0, 0} if each has its own.
  bool has_truth_picture = false;
  std::string problem;  ///< Why nothing was run on it; empty = it could be read.
  bool has_label_picture = false;
};

/// Results of a benchmark; files with pictures and maps lie in `scenes/<scene>/`.
struct BenchmarkReport {
  std::vector<BenchmarkScene> scenes;
  std::vector<BenchmarkResult> results;  ///< By scene, then by entry.
  std::vector<SearchResult> searched;    ///< By scene, method and point; empty without a search.
  bool has_disparities = true;           ///< Whether disparity was asked for,
  bool has_labels = false;               ///< and labels.
  int reused = 0;                        ///< Runs and points that were taken from an earlier call.

  /// Sentences for what failed: scenes that cannot be read, methods, submissions, points.
  [[nodiscard]] std::vector<std::string> failures() const {
    std::vector<std::string> sentences;
    for (const auto& scene : scenes) {
      if (!scene.problem.empty()) sentences.push_back(scene.problem);
    }
    for (const auto& result : results) {
      if (result.has_failed) {
        sentences.push_back(result.entry + " on " + result.scene + ": " + result.problem);
      }
    }
    for (const auto& point : searched) {
      if (!point.problem.empty()) {
        sentences.push_back("search of " + point.method + " on " + point.scene + ": " +
                            point.problem);
      }
    }
    return sentences;
  }
};

/// Every table of a benchmark, in the order of the page: labels, overview, accuracy, beside
/// the paper, search.
[[nodiscard]] std::vector<TitledTable> report_tables(const BenchmarkReport& report);

/// The tables one below the other, each after a line with its title.
[[nodiscard]] std::string tables_to_csv(const std::vector<TitledTable>& tables);
/// The tables as LaTeX, titles and notes as comments.
[[nodiscard]] std::string tables_to_latex(const std::vector<TitledTable>& tables);

/// Writes index.html, tables.csv, tables.tex, results.csv (a result a line, every metric) and
/// results.json into the folder, each atomically. Throws IoError.
void write_report(const std::filesystem::path& folder, const BenchmarkReport& report);

/// One JSON object: "program", "version", "scenes", "ranking" (entry, rank, average MSE × 100,
/// scenes averaged over), of labels "label_ranking" (likewise, by accuracy), "results" (every
/// metric of both protocols, "labels"; what is not known is absent;
/// "figure_7" where the paper has scene and entry), and of a search "search": by method the points
/// with their scores by scene, P-opt, P-fix, LOSO.
[[nodiscard]] std::string report_to_json(const BenchmarkReport& report);

}  // namespace episcope
