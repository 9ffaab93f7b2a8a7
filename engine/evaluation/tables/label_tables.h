// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/evaluation/metrics/label_quality.h"
#include "engine/evaluation/tables/benchmark_tables.h"

#include <optional>
#include <string>
#include <vector>

namespace episcope {

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
