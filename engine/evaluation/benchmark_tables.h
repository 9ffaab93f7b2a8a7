// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/parameter.h"
#include "engine/core/text_table.h"
#include "engine/evaluation/label_quality.h"
#include "engine/evaluation/metrics.h"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace episcope {

/// The index of the value in the list, to which it is appended if it is not there yet.
template <class T>
std::size_t find_or_append(std::vector<T>& list, const T& value) {
  const auto found = std::find(list.begin(), list.end(), value);
  if (found != list.end()) return static_cast<std::size_t>(found - list.begin());
  list.push_back(value);
  return list.size() - 1;
}

/// The result of one entry (a method of this build with its default parameters, an external
/// submission, or a way to label) on one scene. Disparities are evaluated in the center view.
struct BenchmarkResult {
  std::string entry;
  std::string scene;
  bool is_foreign = false;     ///< Submitted from elsewhere.
  double seconds = 0;          ///< Wall-clock time; 0 = not given.
  bool has_all_views = false;  ///< Whether `seconds` is the time of all views.
  Metrics vmv2013;             ///< Empty if there is nothing to judge or to judge against.
  Metrics benchmark2016;       ///< Likewise; also of views smaller than two borders of 15 px.
  Metrics labels;              ///< Of labels, see label_metrics; empty for disparities.
  std::string problem;         ///< Why a score is missing, a sentence; empty = none is.
  bool has_failed = false;     ///< The method or the submission failed, not the scene.
  std::vector<std::string> notes;
};

/// One point of a parameter search on one scene.
struct SearchResult {
  std::string method;
  std::string scene;
  ParameterSet point;  ///< The parameters that are searched.
  std::optional<double> mse_100;
  double seconds = 0;
  std::string problem;
};

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

/// Ranks by the average over the scenes that all ranked entries have, so that omitting a hard scene
/// is no advantage. Entries without any score are not ranked; a scene without any score is neither
/// averaged nor missing. Averages that agree when rounded to `digits` share the better rank, the
/// next one continues the count (1, 1, 3), and keep their order.
[[nodiscard]] Ranking rank_entries(const ScoreMatrix& matrix, int digits);

/// Digits after the point in tables; equal digits are a tie.
inline constexpr int kScoreDigits = 3;

/// A score as tables show it; "–" if there is none.
[[nodiscard]] std::string score_text(const std::optional<double>& score);

/// A table with its title and explanations.
struct TitledTable {
  std::string title;
  std::string note;  ///< Sentences; may be empty.
  TextTable table;
  std::vector<std::pair<std::size_t, std::size_t>> best;  ///< Cells to stress: row, column.
};

/// Scores by one metric of `metrics`, a member like &BenchmarkResult::labels. Entries and scenes
/// stand in the order of their first result.
[[nodiscard]] ScoreMatrix score_matrix(const std::vector<BenchmarkResult>& results,
                                       Metrics BenchmarkResult::*metrics, const std::string& key);
/// Scores by one metric of a protocol.
[[nodiscard]] ScoreMatrix score_matrix(const std::vector<BenchmarkResult>& results,
                                       Protocol protocol, const std::string& key);

/// As figure 7 of the paper: one line per scene, one column per entry, best entry first; then
/// average and rank. If averages omit scenes, a line between them has the average over all scenes
/// of an entry, with their number. Gaps are "–"; the note says which scenes the averages omit and
/// why. The best score of each line is highlighted. Entries and scenes without any score are
/// omitted.
[[nodiscard]] TitledTable accuracy_table(const std::string& title, const ScoreMatrix& matrix);

/// As figure 8: rank, algorithm, average MSE × 100, speed class by the mean time of its scenes,
/// whether that is the time of all views. The note names results that are judged on a part of the
/// pixels alone.
[[nodiscard]] TitledTable overview_table(const std::vector<BenchmarkResult>& results);

/// All tables of a benchmark without search: figures 7 and 8, MSE and BadPix of the 2016 protocol,
/// official and in the resolution of the views, both layers of scenes that have two. Tables without
/// any score are left out.
[[nodiscard]] std::vector<TitledTable> benchmark_tables(
    const std::vector<BenchmarkResult>& results);

/// One line per result with every metric: "entry", "scene", "protocol.metric", …, for other
/// programs.
[[nodiscard]] TextTable results_table(const std::vector<BenchmarkResult>& results);

/// `BenchmarkResult::labels` of labels of all views: "accuracy_all_views", "accuracy_center",
/// "miou", "macc", "boundary_accuracy", "thin_iou", "consistency", then "accuracy_label_N" and
/// "iou_label_N" of every true label N. Shares in [0, 1]; what is not known is absent.
[[nodiscard]] Metrics label_metrics(const LabelQuality& all_views, const LabelQuality& center,
                                    const std::optional<double>& consistency);

/// Tables of results with labels: an overview of the entries by rank, a table of scenes × entries
/// for each metric, and for each scene one of labels × entries with their IoU. In percent, larger
/// is better. None without such results.
[[nodiscard]] std::vector<TitledTable> label_tables(const std::vector<BenchmarkResult>& results);

}  // namespace episcope
