// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/benchmark/report.h"
#include "engine/evaluation/benchmark_tables.h"

#include <optional>
#include <string>
#include <vector>

namespace episcope {

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

}  // namespace episcope
