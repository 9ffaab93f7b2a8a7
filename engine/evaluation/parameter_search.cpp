// SPDX-License-Identifier: BSD-3-Clause
#include "engine/evaluation/parameter_search.h"

#include "engine/core/text.h"

#include <algorithm>
#include <array>
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

/// Which point a protocol takes on a scene.
enum class Rule { PerScene, Equal, LeaveOneOut, Default };
constexpr std::array kRules{Rule::PerScene, Rule::Equal, Rule::LeaveOneOut, Rule::Default};

std::optional<std::size_t> point_of(const MethodSearch& search, Rule rule, std::size_t scene) {
  switch (rule) {
    case Rule::PerScene:
      return search.choice.per_scene[scene];
    case Rule::Equal:
      return search.choice.equal;
    case Rule::LeaveOneOut:
      return search.choice.leave_one_out[scene];
    case Rule::Default:
      break;
  }
  return 0;
}

std::optional<double> score_of(const MethodSearch& search, Rule rule, std::size_t scene) {
  const auto point = point_of(search, rule, scene);
  return point ? search.scores[*point][scene] : std::nullopt;
}

ScoreMatrix matrix_of(const std::vector<MethodSearch>& searches, Rule rule) {
  ScoreMatrix matrix;
  matrix.scenes = searches.front().scenes;
  for (const MethodSearch& search : searches) {
    matrix.entries.push_back(search.method);
    auto& scores = matrix.scores.emplace_back();
    for (std::size_t scene = 0; scene < matrix.scenes.size(); ++scene) {
      scores.push_back(score_of(search, rule, scene));
    }
  }
  return matrix;
}

TitledTable protocol_table(const std::vector<MethodSearch>& searches) {
  TitledTable titled{
      "Parameter search: average MSE × 100 of the center view (vmv2013)",
      "P-opt: the best point for each scene, as in the paper. P-fix: one point for all scenes, "
      "which minimizes the geometric mean of error / best error of the scene. LOSO (leave one "
      "scene out): P-fix chosen without the scene being evaluated. Only the center view is "
      "estimated; the disparity range is found as in any other run, never from the ground truth. "
      "Averages are over the scenes that every method has.",
      {{"algorithm", "rank", "P-opt", "P-fix", "LOSO", "default", "points", "P-fix parameters"},
       {}},
      {}};
  std::vector<Ranking> rankings;
  for (const Rule rule : kRules) {
    rankings.push_back(rank_entries(matrix_of(searches, rule), kScoreDigits));
  }
  for (const std::size_t method : rankings.front().order) {
    const MethodSearch& search = searches[method];
    const int rank = rankings.front().ranks[method];
    std::vector<std::string> cells{search.method, rank > 0 ? std::to_string(rank) : "–"};
    for (const Ranking& ranking : rankings) cells.push_back(score_text(ranking.averages[method]));
    cells.push_back(std::to_string(search.points.size()));
    cells.push_back(search.choice.equal ? point_text(search.points[*search.choice.equal]) : "–");
    titled.table.rows.push_back(std::move(cells));
  }
  return titled;
}

TitledTable method_table(const MethodSearch& search) {
  TitledTable titled{"Parameter search of " + search.method + " by scene (MSE × 100)",
                     "",
                     {{"scene", "P-opt", "P-fix", "LOSO", "default", "P-opt parameters"}, {}},
                     {}};
  for (std::size_t scene = 0; scene < search.scenes.size(); ++scene) {
    std::vector<std::string> cells{search.scenes[scene]};
    for (const Rule rule : kRules) cells.push_back(score_text(score_of(search, rule, scene)));
    const auto best = search.choice.per_scene[scene];
    cells.push_back(best ? point_text(search.points[*best]) : "–");
    titled.table.rows.push_back(std::move(cells));
  }
  return titled;
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

std::vector<MethodSearch> gather_searches(const std::vector<SearchResult>& results) {
  std::vector<std::string> methods;
  std::vector<std::string> scenes;
  for (const SearchResult& result : results) {
    find_or_append(methods, result.method);
    find_or_append(scenes, result.scene);
  }
  std::vector<MethodSearch> searches;
  for (const auto& method : methods) searches.push_back({method, scenes, {}, {}, {}});
  for (const SearchResult& result : results) {
    MethodSearch& search = searches[find_or_append(methods, result.method)];
    const std::size_t point = find_or_append(search.points, result.point);
    search.scores.resize(search.points.size(), std::vector<std::optional<double>>(scenes.size()));
    search.scores[point][find_or_append(scenes, result.scene)] = result.mse_100;
  }
  for (MethodSearch& search : searches) search.choice = choose_parameters(search.scores);
  return searches;
}

std::string point_text(const ParameterSet& point) {
  if (point.empty()) return "default";
  return joined(point, ", ",
                [](const auto& entry) { return entry.first + " " + to_text(entry.second); });
}

std::vector<TitledTable> search_tables(const std::vector<SearchResult>& results) {
  const std::vector<MethodSearch> searches = gather_searches(results);
  if (searches.empty()) return {};
  std::vector<TitledTable> tables{protocol_table(searches)};
  for (const MethodSearch& search : searches) tables.push_back(method_table(search));
  return tables;
}

}  // namespace episcope
