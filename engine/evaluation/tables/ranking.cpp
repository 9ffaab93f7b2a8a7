// SPDX-License-Identifier: BSD-3-Clause
#include "engine/evaluation/tables/ranking.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace episcope {
namespace {

using Scores = std::vector<std::optional<double>>;

void divide_scenes(const ScoreMatrix& matrix, Ranking& ranking) {
  for (std::size_t scene = 0; scene < matrix.scenes.size(); ++scene) {
    bool is_scored = false;
    bool has_gap = false;
    for (const Scores& scores : matrix.scores) {
      if (!has_score(scores)) continue;
      (scores[scene] ? is_scored : has_gap) = true;
    }
    if (is_scored) (has_gap ? ranking.missing : ranking.scenes).push_back(scene);
  }
}

std::optional<double> average(const Scores& scores, const std::vector<std::size_t>& scenes) {
  if (scenes.empty() || !has_score(scores)) return std::nullopt;
  double sum = 0;
  for (const std::size_t scene : scenes) sum += *scores[scene];
  return sum / static_cast<double>(scenes.size());
}

}  // namespace

bool has_score(const Scores& scores) {
  return std::any_of(scores.begin(), scores.end(),
                     [](const auto& score) { return score.has_value(); });
}

Ranking rank_entries(const ScoreMatrix& matrix, int digits) {
  Ranking ranking;
  divide_scenes(matrix, ranking);
  for (const Scores& scores : matrix.scores) {
    ranking.averages.push_back(average(scores, ranking.scenes));
  }
  const double unit = std::pow(10.0, digits);
  const auto shown = [&](std::size_t entry) { return std::round(*ranking.averages[entry] * unit); };
  const auto is_ranked = [&](std::size_t entry) { return ranking.averages[entry].has_value(); };

  ranking.order.resize(matrix.entries.size());
  std::iota(ranking.order.begin(), ranking.order.end(), std::size_t{0});
  const auto unranked =
      std::stable_partition(ranking.order.begin(), ranking.order.end(), is_ranked);
  const bool is_falling = matrix.better == BetterScore::Larger;
  std::stable_sort(ranking.order.begin(), unranked, [&](std::size_t a, std::size_t b) {
    return is_falling ? shown(a) > shown(b) : shown(a) < shown(b);
  });

  ranking.ranks.assign(matrix.entries.size(), 0);
  for (auto place = ranking.order.begin(); place != unranked; ++place) {
    const bool is_tied = place != ranking.order.begin() && shown(*place) == shown(*(place - 1));
    ranking.ranks[*place] =
        is_tied ? ranking.ranks[*(place - 1)] : static_cast<int>(place - ranking.order.begin()) + 1;
  }
  return ranking;
}

}  // namespace episcope
