// SPDX-License-Identifier: BSD-3-Clause
#include "engine/evaluation/metrics/label_accuracy.h"

#include "engine/core/error.h"

#include <fmt/format.h>

#include <string>

namespace episcope {
namespace {

std::optional<double> share_of(std::int64_t right, std::int64_t all) {
  if (all == 0) return std::nullopt;
  return static_cast<double>(right) / static_cast<double>(all);
}

template <class Value>
std::optional<double> mean_over(const std::vector<std::int32_t>& labels, const Value& value) {
  if (labels.empty()) return std::nullopt;
  double sum = 0;
  for (const std::int32_t label : labels) sum += value(label);
  return sum / static_cast<double>(labels.size());
}

}  // namespace

std::int64_t LabelAccuracy::judged() const {
  std::int64_t all = 0;
  for (const auto& entry : confusion) all += entry.second;
  return all;
}

std::optional<double> LabelAccuracy::share() const {
  std::int64_t right = 0;
  for (const auto& [pair, count] : confusion) {
    if (pair.first == pair.second) right += count;
  }
  return share_of(right, judged());
}

std::optional<double> LabelAccuracy::share(std::int32_t label) const {
  std::int64_t right = 0;
  std::int64_t all = 0;
  for (const auto& [pair, count] : confusion) {
    if (pair.first != label) continue;
    all += count;
    if (pair.second == label) right += count;
  }
  return share_of(right, all);
}

std::vector<std::int32_t> LabelAccuracy::labels() const {
  std::vector<std::int32_t> found;
  for (const auto& entry : confusion) {
    const std::int32_t label = entry.first.first;
    if (found.empty() || found.back() != label) found.push_back(label);
  }
  return found;
}

std::optional<double> LabelAccuracy::mean_share() const {
  return mean_over(labels(), [this](std::int32_t label) { return share(label).value_or(0); });
}

std::optional<double> LabelAccuracy::overlap(std::int32_t label) const {
  std::int64_t both = 0;
  std::int64_t either = 0;
  bool is_true = false;
  for (const auto& [pair, count] : confusion) {
    is_true |= pair.first == label;
    if (pair.first == label || pair.second == label) either += count;
    if (pair.first == label && pair.second == label) both += count;
  }
  if (!is_true) return std::nullopt;
  return share_of(both, either);
}

std::optional<double> LabelAccuracy::mean_overlap() const {
  return mean_over(labels(), [this](std::int32_t label) { return overlap(label).value_or(0); });
}

LabelAccuracy& LabelAccuracy::operator+=(const LabelAccuracy& other) {
  for (const auto& [pair, count] : other.confusion) confusion[pair] += count;
  return *this;
}

LabelAccuracy judge_labels(ImageView<const std::int32_t> labels,
                           ImageView<const std::int32_t> truth) {
  if (labels.height != truth.height || labels.width != truth.width) {
    throw InvalidInput(
        fmt::format("labels of {}×{} px cannot be compared with true labels of {}×{} px",
                    labels.width, labels.height, truth.width, truth.height));
  }
  LabelAccuracy accuracy;
  for (int y = 0; y < truth.height; ++y) {
    const std::int32_t* given = labels.row(y);
    const std::int32_t* right = truth.row(y);
    for (int x = 0; x < truth.width;) {
      // Runs of equal pairs: the map is asked once for each.
      int end = x + 1;
      while (end < truth.width && right[end] == right[x] && given[end] == given[x]) ++end;
      if (right[x] > 0) accuracy.confusion[{right[x], given[x]}] += end - x;
      x = end;
    }
  }
  return accuracy;
}

LabelAccuracy judge_labels(const ViewStack<std::int32_t>& labels,
                           const ViewStack<std::int32_t>& truth) {
  LabelAccuracy accuracy;
  for (int i = 0; i < labels.grid().count(); ++i) {
    const ViewIndex view = labels.view_at(i);
    if (!truth.empty() && truth.contains(view)) {
      accuracy += judge_labels(labels.view(view), truth.view(view));
    }
  }
  return accuracy;
}

}  // namespace episcope
