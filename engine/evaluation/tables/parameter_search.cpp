// SPDX-License-Identifier: BSD-3-Clause
#include "engine/evaluation/tables/parameter_search.h"

#include <algorithm>
#include <cmath>

namespace episcope {
namespace {

// Keeps the logarithm of a perfect score finite: 1e-4 px off.
constexpr double kMinError = 1e-6;

std::optional<std::size_t> best_of_scene(const SearchScores& scores, std::size_t scene) {
  std::optional<std::size_t> best;
  for (std::size_t point = 0; point < scores.size(); ++point) {
    const auto& score = scores[point][scene];
    if (score && (!best || *score < *scores[*best][scene])) best = point;
  }
  return best;
}

/// Sum of log errors; the least error of a scene is a factor that all points share.
std::optional<double> log_error(const std::vector<std::optional<double>>& errors,
                                const std::vector<std::size_t>& scenes) {
  double sum = 0;
  for (const std::size_t scene : scenes) {
    if (!errors[scene]) return std::nullopt;
    sum += std::log(std::max(*errors[scene], kMinError));
  }
  return sum;
}

std::optional<std::size_t> best_of_all(const SearchScores& scores,
                                       const std::vector<std::size_t>& scenes) {
  std::optional<std::size_t> best;
  std::optional<double> least;
  if (scenes.empty()) return best;
  for (std::size_t point = 0; point < scores.size(); ++point) {
    const auto error = log_error(scores[point], scenes);
    if (!error || (least && !(*error < *least))) continue;
    best = point;
    least = error;
  }
  return best;
}

}  // namespace

std::vector<ParameterSet> search_grid(const std::vector<ParameterDescription>& parameters) {
  ParameterSet defaults;
  std::vector<ParameterSet> points{{}};
  for (const auto& parameter : parameters) {
    if (parameter.searched.empty()) continue;
    defaults.emplace_back(parameter.key, parameter.default_value);
    std::vector<ParameterSet> longer;
    for (const ParameterSet& point : points) {
      for (const ParameterValue& value : parameter.searched) {
        longer.push_back(point);
        longer.back().emplace_back(parameter.key, value);
      }
    }
    points = std::move(longer);
  }
  std::erase(points, defaults);
  points.insert(points.begin(), defaults);
  return points;
}

ParameterChoice choose_parameters(const SearchScores& scores) {
  ParameterChoice choice;
  const std::size_t scene_count = scores.empty() ? 0 : scores.front().size();
  std::vector<std::size_t> scored;
  for (std::size_t scene = 0; scene < scene_count; ++scene) {
    choice.per_scene.push_back(best_of_scene(scores, scene));
    if (choice.per_scene.back()) scored.push_back(scene);
  }
  choice.equal = best_of_all(scores, scored);
  choice.leave_one_out.resize(scene_count);
  for (const std::size_t scene : scored) {
    std::vector<std::size_t> others = scored;
    std::erase(others, scene);
    choice.leave_one_out[scene] = best_of_all(scores, others);
  }
  return choice;
}

}  // namespace episcope
