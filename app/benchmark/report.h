// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/indices.h"
#include "engine/evaluation/benchmark_tables.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace episcope {

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

/// A line of figure 7 of the paper.
struct PublishedScene {
  std::string name;
  std::string other_name;       ///< In figure 1, if it has another one there.
  std::vector<double> mse_100;  ///< As `PublishedFigures::algorithms`.
};

/// A line of figure 8.
struct PublishedAlgorithm {
  std::string name;
  double mse_100 = 0;  ///< Average over the scenes.
  std::string speed;   ///< "fast" (less than 5 s), "medium" (less than a minute), "slow".
  bool all_views = false;
};

/// Figures 7 and 8 of the paper [WMG13], from resources/vmv2013.json: mean squared errors in px² ×
/// 100 of the center view, each with the best parameters for its scene.
struct PublishedFigures {
  std::vector<std::string> algorithms;
  std::vector<PublishedScene> scenes;
  std::vector<double> averages;  ///< As printed; the paper averaged unrounded scores.
  std::vector<PublishedAlgorithm> ranking;

  /// The error of an algorithm on a scene; empty if the paper has no such pair. Letters may be
  /// large or small, and what is neither letter nor digit is passed over: "still_life" is
  /// "stillLife".
  [[nodiscard]] std::optional<double> mse_100(const std::string& scene,
                                              const std::string& algorithm) const;
  /// Null for an algorithm that the paper does not have.
  [[nodiscard]] const PublishedAlgorithm* find(const std::string& algorithm) const;
};
[[nodiscard]] const PublishedFigures& published_figures();

/// Scores of the paper's algorithms on its scenes beside figure 7: of the runs, and of a search the
/// best point of each scene, which is how the paper chose its parameters. No rows if the report has
/// none of these scenes.
[[nodiscard]] TitledTable published_table(const BenchmarkReport& report);

/// The text of resources/vmv2013.json, compiled in: its source is made when the build is
/// configured.
extern const char* const kPublishedData;
/// Style and script of the page, from resources/benchmark.
extern const char* const kReportStyle;
extern const char* const kReportScript;

/// The page of a benchmark: its tables, then for each scene pictures of the view, the truth, and of
/// every entry disparity and error. Needs nothing but the files beside it; light or dark as the
/// reader's system; a small script sorts tables by a click, all else works without.
[[nodiscard]] std::string html_page(const BenchmarkReport& report,
                                    const std::vector<TitledTable>& tables);

}  // namespace episcope
