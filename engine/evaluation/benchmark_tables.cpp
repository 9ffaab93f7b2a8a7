// SPDX-License-Identifier: BSD-3-Clause
#include "engine/evaluation/benchmark_tables.h"

#include "engine/core/text.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <numeric>
#include <set>

namespace episcope {
namespace {

using Scores = std::vector<std::optional<double>>;

// Whether an entry has any score.
bool has_score(const Scores& scores) {
  return std::any_of(scores.begin(), scores.end(),
                     [](const auto& score) { return score.has_value(); });
}

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

constexpr const char* kGap = "–";

Metrics BenchmarkResult::*metrics_of(Protocol protocol) {
  return protocol == Protocol::Vmv2013 ? &BenchmarkResult::vmv2013
                                       : &BenchmarkResult::benchmark2016;
}

std::string rank_text(int rank) {
  return rank > 0 ? std::to_string(rank) : kGap;
}

/// "Averages and ranks are over 2 of 3 scenes, …. Left out for a gap: cotton (epi_c)."
std::string gap_note(const ScoreMatrix& matrix, const Ranking& ranking) {
  if (ranking.missing.empty()) return {};
  std::vector<std::string> gaps;
  for (const std::size_t scene : ranking.missing) {
    std::vector<std::string> lacking;
    for (std::size_t entry = 0; entry < matrix.entries.size(); ++entry) {
      const auto& scores = matrix.scores[entry];
      if (has_score(scores) && !scores[scene]) lacking.push_back(matrix.entries[entry]);
    }
    gaps.push_back(matrix.scenes[scene] + " (" + joined(lacking, ", ") + ")");
  }
  const std::size_t total = ranking.scenes.size() + ranking.missing.size();
  const std::string left_out = "Left out because of missing scores: " + joined(gaps, ", ") + ".";
  if (ranking.scenes.empty()) {
    return "No scene has a score for every entry, so there is no ranking. " + left_out;
  }
  return fmt::format(
      "Averages and ranks are over {} of {} scenes, those with scores for every ranked entry. {}",
      ranking.scenes.size(), total, left_out);
}

bool is_scored(const ScoreMatrix& matrix, std::size_t scene) {
  return std::any_of(matrix.scores.begin(), matrix.scores.end(),
                     [&](const auto& scores) { return scores[scene].has_value(); });
}

/// Stresses the best of the last line, as it is shown.
void stress_best(TitledTable& titled, const std::vector<std::optional<double>>& scores,
                 BetterScore better) {
  const auto best =
      std::min_element(scores.begin(), scores.end(), [better](const auto& a, const auto& b) {
        return a && (!b || (better == BetterScore::Larger ? *a > *b : *a < *b));
      });
  if (best == scores.end() || !*best) return;
  for (std::size_t i = 0; i < scores.size(); ++i) {
    if (scores[i] && score_text(scores[i]) == score_text(*best)) {
      titled.best.emplace_back(titled.table.rows.size() - 1, i + 1);
    }
  }
}

void add_scores(TitledTable& titled, const std::string& name,
                const std::vector<std::optional<double>>& scores, BetterScore better) {
  std::vector<std::string> cells{name};
  for (const auto& score : scores) cells.push_back(score_text(score));
  titled.table.rows.push_back(std::move(cells));
  stress_best(titled, scores, better);
}

/// Of every scene that an entry has, and of how many: no two entries need have the same.
std::vector<std::string> own_averages(const ScoreMatrix& matrix,
                                      const std::vector<std::size_t>& order) {
  std::vector<std::string> cells{"average of its own scenes"};
  for (const std::size_t entry : order) {
    double sum = 0;
    int count = 0;
    for (const auto& score : matrix.scores[entry]) {
      sum += score.value_or(0);
      count += score ? 1 : 0;
    }
    cells.push_back(fmt::format("{} ({})", fixed_text(sum / count, kScoreDigits), count));
  }
  return cells;
}

/// Time and views of an entry over its scenes.
struct Speed {
  double seconds = 0;
  int timed = 0;
  bool has_all_views = true;

  [[nodiscard]] double mean() const { return timed > 0 ? seconds / timed : 0; }
};

Speed speed_of(const std::vector<BenchmarkResult>& results, const std::string& entry) {
  Speed speed;
  for (const BenchmarkResult& result : results) {
    if (result.entry != entry || !(result.seconds > 0)) continue;
    speed.seconds += result.seconds;
    ++speed.timed;
    speed.has_all_views = speed.has_all_views && result.has_all_views;
  }
  speed.has_all_views = speed.has_all_views && speed.timed > 0;
  return speed;
}

/// Says which results are judged on a part of their views alone, since their ranks tell little.
std::string part_note(const std::vector<BenchmarkResult>& results) {
  std::string parts;
  for (const BenchmarkResult& result : results) {
    const auto shown = find_metric(result.vmv2013, "shown");
    if (!shown || *shown >= 100) continue;
    parts += fmt::format("{}{} on {} ({:.1f} %)", parts.empty() ? "" : ", ", result.entry,
                         result.scene, *shown);
  }
  return parts.empty() ? "" : " Judged on a part of the pixels alone: " + parts + ".";
}

void add_columns(TextTable& table, const std::vector<BenchmarkResult>& results,
                 Metrics BenchmarkResult::*metrics, const std::string& name) {
  std::vector<std::string> keys;
  for (const BenchmarkResult& result : results) {
    for (const auto& [key, value] : result.*metrics) find_or_append(keys, key);
  }
  constexpr int exact_digits = 6;
  for (const auto& key : keys) {
    table.header.push_back(name + "." + key);
    for (std::size_t i = 0; i < results.size(); ++i) {
      const auto value = find_metric(results[i].*metrics, key);
      table.rows[i].push_back(value ? fixed_text(*value, exact_digits) : "");
    }
  }
}

struct LabelMetric {
  const char* key;
  const char* title;
  const char* column;
};

constexpr LabelMetric kMetrics[] = {
    {"accuracy_all_views", "Accuracy: % of the pixels of all views", "accuracy"},
    {"miou", "Mean intersection over union of the labels, %", "mIoU"},
    {"macc", "Mean accuracy of the labels, %", "mAcc"},
    {"boundary_accuracy", "Boundary accuracy: % of the pixels within 3 px of a true boundary",
     "boundaries"},
    {"thin_iou", "Mean intersection over union of the labels up to 4 px wide, %", "thin IoU"},
    {"consistency", "Consistency: % of the rays whose label is that of the same point elsewhere",
     "consistency"},
};

std::vector<BenchmarkResult> with_labels(const std::vector<BenchmarkResult>& results) {
  std::vector<BenchmarkResult> labeled;
  std::ranges::copy_if(results, std::back_inserter(labeled),
                       [](const BenchmarkResult& result) { return !result.labels.empty(); });
  return labeled;
}

ScoreMatrix percentages(const std::vector<BenchmarkResult>& results, const std::string& key) {
  ScoreMatrix matrix = score_matrix(results, &BenchmarkResult::labels, key);
  matrix.better = BetterScore::Larger;
  for (auto& scores : matrix.scores) {
    for (auto& score : scores) {
      if (score) *score *= 100;
    }
  }
  return matrix;
}

TitledTable overview(const std::vector<BenchmarkResult>& results) {
  TitledTable titled{"Labels ranked by average accuracy, % of all views",
                     "Averages are over the scenes that every entry has; seconds are the mean over "
                     "the scenes, without estimating disparity.",
                     {{"algorithm", "rank"}, {}},
                     {}};
  std::vector<Ranking> rankings;
  ScoreMatrix first;
  for (const LabelMetric& metric : kMetrics) {
    const ScoreMatrix matrix = percentages(results, metric.key);
    rankings.push_back(rank_entries(matrix, kScoreDigits));
    titled.table.header.emplace_back(metric.column);
    if (first.entries.empty()) first = matrix;
  }
  titled.table.header.emplace_back("seconds");
  for (const std::size_t entry : rankings[0].order) {
    const int rank = rankings[0].ranks[entry];
    std::vector<std::string> cells{first.entries[entry], rank > 0 ? std::to_string(rank) : "–"};
    for (const Ranking& ranking : rankings) cells.push_back(score_text(ranking.averages[entry]));
    cells.push_back(fixed_text(speed_of(results, first.entries[entry]).mean(), 2));
    titled.table.rows.push_back(std::move(cells));
  }
  return titled;
}

/// The labels of a scene take the place of scenes.
TitledTable table_of_scene(const std::vector<BenchmarkResult>& results, const std::string& scene) {
  constexpr const char* prefix = "iou_label_";
  std::vector<BenchmarkResult> of_labels;
  for (const BenchmarkResult& result : results) {
    if (result.scene != scene) continue;
    for (const auto& [key, value] : result.labels) {
      if (!key.starts_with(prefix)) continue;
      BenchmarkResult& of_label = of_labels.emplace_back();
      of_label.entry = result.entry;
      of_label.scene = "label " + key.substr(std::string(prefix).size());
      of_label.labels = {{prefix, value}};
    }
  }
  TitledTable titled = accuracy_table(scene + ": intersection over union of each label, %",
                                      percentages(of_labels, prefix));
  titled.table.header.front() = "label";
  return titled;
}

}  // namespace

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

std::string score_text(const std::optional<double>& score) {
  return score ? fixed_text(*score, kScoreDigits) : kGap;
}

ScoreMatrix score_matrix(const std::vector<BenchmarkResult>& results, Protocol protocol,
                         const std::string& key) {
  return score_matrix(results, metrics_of(protocol), key);
}

ScoreMatrix score_matrix(const std::vector<BenchmarkResult>& results,
                         Metrics BenchmarkResult::*metrics, const std::string& key) {
  ScoreMatrix matrix;
  for (const BenchmarkResult& result : results) {
    find_or_append(matrix.entries, result.entry);
    find_or_append(matrix.scenes, result.scene);
  }
  matrix.scores.assign(matrix.entries.size(),
                       std::vector<std::optional<double>>(matrix.scenes.size()));
  for (const BenchmarkResult& result : results) {
    matrix.scores[find_or_append(matrix.entries, result.entry)]
                 [find_or_append(matrix.scenes, result.scene)] = find_metric(result.*metrics, key);
  }
  return matrix;
}

TitledTable accuracy_table(const std::string& title, const ScoreMatrix& matrix) {
  Ranking ranking = rank_entries(matrix, kScoreDigits);
  std::erase_if(ranking.order, [&](std::size_t entry) { return !has_score(matrix.scores[entry]); });
  TitledTable titled{title, gap_note(matrix, ranking), {{"scene"}, {}}, {}};
  for (const std::size_t entry : ranking.order) {
    titled.table.header.push_back(matrix.entries[entry]);
  }
  const auto in_order = [&](const auto& value_of) {
    std::vector<std::optional<double>> values;
    for (const std::size_t entry : ranking.order) values.push_back(value_of(entry));
    return values;
  };
  for (std::size_t scene = 0; scene < matrix.scenes.size(); ++scene) {
    if (!is_scored(matrix, scene)) continue;
    add_scores(titled, matrix.scenes[scene],
               in_order([&](std::size_t entry) { return matrix.scores[entry][scene]; }),
               matrix.better);
  }
  add_scores(titled, "average",
             in_order([&](std::size_t entry) { return ranking.averages[entry]; }), matrix.better);
  if (!ranking.missing.empty()) {
    titled.table.rows.push_back(own_averages(matrix, ranking.order));
  }
  std::vector<std::string> ranks{"rank"};
  for (const std::size_t entry : ranking.order) ranks.push_back(rank_text(ranking.ranks[entry]));
  titled.table.rows.push_back(std::move(ranks));
  return titled;
}

TitledTable overview_table(const std::vector<BenchmarkResult>& results) {
  const ScoreMatrix matrix = score_matrix(results, Protocol::Vmv2013, "mse_100");
  const Ranking ranking = rank_entries(matrix, kScoreDigits);
  TitledTable titled{"Algorithms ranked by average accuracy, as in figure 8 (MSE × 100)",
                     "Speed was measured on this machine: fast is under 5 s, medium up to a "
                     "minute, slow above; seconds are the mean over the scenes.",
                     {{"algorithm", "rank", "accuracy", "speed", "seconds", "all views"}, {}},
                     {}};
  if (const std::string note = gap_note(matrix, ranking); !note.empty()) titled.note += " " + note;
  titled.note += part_note(results);
  for (const std::size_t entry : ranking.order) {
    const Speed speed = speed_of(results, matrix.entries[entry]);
    const bool is_timed = speed.timed > 0;
    titled.table.rows.push_back(
        {matrix.entries[entry], rank_text(ranking.ranks[entry]),
         score_text(ranking.averages[entry]), is_timed ? runtime_class(speed.mean()) : "not given",
         is_timed ? fixed_text(speed.mean(), 2) : "not given", speed.has_all_views ? "yes" : ""});
  }
  return titled;
}

std::vector<TitledTable> benchmark_tables(const std::vector<BenchmarkResult>& results) {
  struct Choice {
    const char* title;
    Protocol protocol;
    const char* key;
  };
  constexpr Choice choices[] = {
      {"Mean squared error × 100 of the center view, as in figure 7 (vmv2013)", Protocol::Vmv2013,
       "mse_100"},
      {"Transparent scenes, foreground: mean squared error × 100 (vmv2013)", Protocol::Vmv2013,
       "mse_100_foreground"},
      {"Transparent scenes, background: mean squared error × 100 (vmv2013)", Protocol::Vmv2013,
       "mse_100_background"},
      {"Mean squared error × 100 without a border of 15 px (benchmark2016)",
       Protocol::Benchmark2016, "mse_100"},
      {"BadPix 0.07: % of the pixels that are off by more than 0.07 px (benchmark2016)",
       Protocol::Benchmark2016, "badpix_0070"},
      {"Scenes whose official score needs high resolution: mean squared error × 100 in the "
       "resolution of the views (benchmark2016)",
       Protocol::Benchmark2016, "mse_100_lowres"},
      {"Scenes whose official score needs high resolution: BadPix 0.07 in the resolution of the "
       "views (benchmark2016)",
       Protocol::Benchmark2016, "badpix_0070_lowres"},
  };
  std::vector<TitledTable> tables{overview_table(results)};
  for (const Choice& choice : choices) {
    const ScoreMatrix matrix = score_matrix(results, choice.protocol, choice.key);
    TitledTable table = accuracy_table(choice.title, matrix);
    constexpr std::size_t summary_rows = 2;  // average and rank
    if (table.table.rows.size() > summary_rows) tables.push_back(std::move(table));
  }
  return tables;
}

TextTable results_table(const std::vector<BenchmarkResult>& results) {
  TextTable table{{"entry", "scene", "seconds", "all_views"}, {}};
  constexpr int time_digits = 3;
  for (const BenchmarkResult& result : results) {
    table.rows.push_back({result.entry, result.scene,
                          result.seconds > 0 ? fixed_text(result.seconds, time_digits) : "",
                          result.has_all_views ? "yes" : "no"});
  }
  for (const Protocol protocol : {Protocol::Vmv2013, Protocol::Benchmark2016}) {
    add_columns(table, results, metrics_of(protocol), protocol_name(protocol));
  }
  add_columns(table, results, &BenchmarkResult::labels, "labels");
  table.header.emplace_back("problem");
  for (std::size_t i = 0; i < results.size(); ++i) table.rows[i].push_back(results[i].problem);
  return table;
}

Metrics label_metrics(const LabelQuality& all_views, const LabelQuality& center,
                      const std::optional<double>& consistency) {
  Metrics metrics;
  const auto add = [&metrics](const std::string& key, const std::optional<double>& share) {
    if (share) metrics.emplace_back(key, *share);
  };
  add("accuracy_all_views", all_views.all.share());
  add("accuracy_center", center.all.share());
  add("miou", all_views.all.mean_overlap());
  add("macc", all_views.all.mean_share());
  add("boundary_accuracy", all_views.boundaries.share());
  add("thin_iou", all_views.thin_overlap());
  add("consistency", consistency);
  for (const std::int32_t label : all_views.all.labels()) {
    add(fmt::format("accuracy_label_{}", label), all_views.all.share(label));
    add(fmt::format("iou_label_{}", label), all_views.all.overlap(label));
  }
  return metrics;
}

std::vector<TitledTable> label_tables(const std::vector<BenchmarkResult>& results) {
  const std::vector<BenchmarkResult> labeled = with_labels(results);
  if (labeled.empty()) return {};
  std::vector<TitledTable> tables{overview(labeled)};
  for (const LabelMetric& metric : kMetrics) {
    const ScoreMatrix matrix = percentages(labeled, metric.key);
    if (std::ranges::any_of(matrix.scores, has_score)) {
      tables.push_back(accuracy_table(metric.title, matrix));
    }
  }
  std::set<std::string> seen;
  for (const BenchmarkResult& result : labeled) {
    if (seen.insert(result.scene).second) tables.push_back(table_of_scene(labeled, result.scene));
  }
  return tables;
}

}  // namespace episcope
