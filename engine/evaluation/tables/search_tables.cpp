// SPDX-License-Identifier: BSD-3-Clause
#include "engine/evaluation/tables/search_tables.h"

#include "engine/core/text/join.h"
#include "engine/evaluation/tables/find_or_append.h"

#include <algorithm>
#include <array>

namespace episcope {
namespace {

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
      "Parameter search: average MSE × 100 of the centre view (vmv2013)",
      "P-opt: the best point for each scene, as in the paper. P-fix: one point for all scenes, "
      "which minimises the geometric mean of error / best error of the scene. LOSO (leave one "
      "scene out): P-fix chosen without the scene being evaluated. Only the centre view is "
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
