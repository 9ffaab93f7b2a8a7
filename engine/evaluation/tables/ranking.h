// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace episcope {

/// Which scores are the better ones.
enum class BetterScore { Smaller, Larger };

/// Scores of entries (methods, submissions) on scenes; empty = a gap.
struct ScoreMatrix {
  std::vector<std::string> entries;
  std::vector<std::string> scenes;
  std::vector<std::vector<std::optional<double>>> scores;  ///< [entry][scene]
  BetterScore better = BetterScore::Smaller;
};

/// Entries in the order of their averages.
struct Ranking {
  std::vector<std::size_t> scenes;   ///< Averaged over: those that every ranked entry has.
  std::vector<std::size_t> missing;  ///< Left out of the averages: a ranked entry has a gap there.
  std::vector<std::optional<double>> averages;  ///< [entry], empty = not ranked.
  std::vector<int> ranks;                       ///< [entry], from 1; 0 = not ranked.
  std::vector<std::size_t> order;               ///< Entries, best first, those not ranked last.
};

/// Whether an entry has any score.
[[nodiscard]] bool has_score(const std::vector<std::optional<double>>& scores);

/// Ranks by the average over the scenes that all ranked entries have, so that omitting a hard scene
/// is no advantage. Entries without any score are not ranked; a scene without any score is neither
/// averaged nor missing. Averages that agree when rounded to `digits` share the better rank, the
/// next one continues the count (1, 1, 3), and keep their order.
[[nodiscard]] Ranking rank_entries(const ScoreMatrix& matrix, int digits);

}  // namespace episcope
