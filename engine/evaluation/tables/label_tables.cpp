// SPDX-License-Identifier: BSD-3-Clause
#include "engine/evaluation/tables/label_tables.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <set>

namespace episcope {
namespace {

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

double mean_seconds(const std::vector<BenchmarkResult>& results, const std::string& entry) {
  double sum = 0;
  int count = 0;
  for (const BenchmarkResult& result : results) {
    if (result.entry != entry) continue;
    sum += result.seconds;
    ++count;
  }
  return count > 0 ? sum / count : 0;
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
    cells.push_back(fixed_text(mean_seconds(results, first.entries[entry]), 2));
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
