// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/parameter.h"
#include "engine/evaluation/benchmark_tables.h"

#include <cstddef>
#include <optional>
#include <vector>

namespace episcope {

/// Maximum number of points in the search of a method.
inline constexpr std::size_t kMaxSearchPoints = 60;

/// The points that a search tries: the product of `ParameterDescription::searched`, in the order of
/// the parameters, the last one running fastest. The first point is the default, whether or not it
/// lies on the grid. A point holds the parameters that are searched; the others keep their
/// defaults.
[[nodiscard]] std::vector<ParameterSet> search_grid(
    const std::vector<ParameterDescription>& parameters);

/// Errors by `[point][scene]`; empty = not known. Point 0 is the default.
using SearchScores = std::vector<std::vector<std::optional<double>>>;

/// The point that each protocol selects, by scene. Empty where no point has a score.
struct ParameterChoice {
  /// The best of each scene, as in the paper ("we did a parameter search to find the optimum for
  /// all methods on each data set separately" [WMG13]).
  std::vector<std::optional<std::size_t>> per_scene;
  /// One for all scenes, the "second run with equal parameter values" that the paper announces.
  std::optional<std::size_t> equal;
  /// One for each scene, chosen without it: the value of equal parameters on an unknown scene.
  /// Empty with fewer than two scenes.
  std::vector<std::optional<std::size_t>> leave_one_out;
};

/// Equal parameters minimise the geometric mean over the scenes of error / (least error of the
/// scene), so that no scene weighs more for being hard. Only points with a score on every scene
/// that counts can be chosen; scenes without any score do not count. Of equals the first is taken.
[[nodiscard]] ParameterChoice choose_parameters(const SearchScores& scores);

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

/// First a table of the averages of every method under each protocol, ranked by P-opt: the best
/// point of each scene (P-opt, as figure 7), equal parameters for all scenes (P-fix), equal
/// parameters chosen without the judged scene (LOSO), the default. Then a table for each method:
/// its scenes with scores and points. Empty without results.
[[nodiscard]] std::vector<TitledTable> search_tables(const std::vector<SearchResult>& results);

}  // namespace episcope
