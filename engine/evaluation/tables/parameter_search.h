// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/parameter/parameter.h"

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
  /// The same, chosen without the scene that it is evaluated on: what equal parameters are worth on
  /// an unknown scene. Empty with fewer than two scenes.
  std::vector<std::optional<std::size_t>> leave_one_out;
};

/// Equal parameters minimise the geometric mean over the scenes of error / (least error of the
/// scene), so that no scene weighs more for being hard. Only points with a score on every scene
/// that counts can be chosen; scenes without any score do not count. Of equals the first is taken.
[[nodiscard]] ParameterChoice choose_parameters(const SearchScores& scores);

}  // namespace episcope
