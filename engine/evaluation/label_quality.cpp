// SPDX-License-Identifier: BSD-3-Clause
#include "engine/evaluation/label_quality.h"

#include "engine/core/error.h"
#include "engine/core/parallel.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

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

// Each of the two at most once.
class OneToOne {
 public:
  void add(std::int32_t given, std::int32_t truth) {
    if (true_of_.contains(given) || !taken_.insert(truth).second) return;
    true_of_[given] = truth;
  }
  [[nodiscard]] const std::map<std::int32_t, std::int32_t>& pairs() const { return true_of_; }

 private:
  std::map<std::int32_t, std::int32_t> true_of_;
  std::set<std::int32_t> taken_;
};

// Row by row, then column by column: `combine` over the window around each pixel.
template <class T, class Combine>
Image<T> over_windows(ImageView<const T> image, int radius, const Combine& combine) {
  const auto along = [&](ImageView<const T> from, bool is_row) {
    Image<T> out(from.height, from.width);
    for (int y = 0; y < from.height; ++y) {
      for (int x = 0; x < from.width; ++x) {
        T value = from.at(y, x);
        const int here = is_row ? x : y;
        const int last = std::min(here + radius, (is_row ? from.width : from.height) - 1);
        for (int i = std::max(here - radius, 0); i <= last; ++i) {
          value = combine(value, is_row ? from.at(y, i) : from.at(i, x));
        }
        out.at(y, x) = value;
      }
    }
    return out;
  };
  const Image<T> rows = along(image, true);
  return along(rows.view(), false);
}

// 1 where a pixel of another label lies in the square of 2·radius + 1 px around the pixel,
// `[y][x]`.
Image<std::uint8_t> near_boundaries(ImageView<const std::int32_t> labels, int radius) {
  const auto least = over_windows(labels, radius, [](auto a, auto b) { return std::min(a, b); });
  const auto most = over_windows(labels, radius, [](auto a, auto b) { return std::max(a, b); });
  Image<std::uint8_t> near(labels.height, labels.width);
  std::transform(least.begin(), least.end(), most.begin(), near.begin(),
                 [](auto a, auto b) { return static_cast<std::uint8_t>(a != b); });
  return near;
}

// 1 where the pixel lies in no square of kThinWidth_px + 1 px of its label alone, `[y][x]`: what a
// morphological opening of the label removes. Squares end at the border of the image.
Image<std::uint8_t> thin_parts(ImageView<const std::int32_t> labels) {
  // A square without a boundary covers all of its pixels.
  const Image<std::uint8_t> mixed = near_boundaries(labels, kThinWidth_px / 2);
  const ImageView<const std::uint8_t> view = mixed.view();
  return over_windows(view, kThinWidth_px / 2, [](auto a, auto b) { return std::min(a, b); });
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

LabelAccuracy LabelAccuracy::matched(const LabelMatch& match) const {
  constexpr std::int32_t kNoTrueLabel = -1;
  LabelAccuracy renumbered;
  for (const auto& [pair, count] : confusion) {
    const auto found = match.true_of.find(pair.second);
    const std::int32_t stands_for = found == match.true_of.end() ? kNoTrueLabel : found->second;
    renumbered.confusion[{pair.first, stands_for}] += count;
  }
  return renumbered;
}

LabelMatch match_labels(const LabelAccuracy& accuracy, const std::vector<LabelInfo>& given,
                        const std::vector<LabelInfo>& truth) {
  OneToOne matches;
  for (const LabelInfo& label : given) {
    const auto same = std::ranges::find(truth, label.name, &LabelInfo::name);
    if (same != truth.end()) matches.add(label.id, same->id);
  }
  const std::size_t named = matches.pairs().size();
  using Overlap = std::pair<std::int64_t, std::pair<std::int32_t, std::int32_t>>;
  std::vector<Overlap> overlaps;
  for (const auto& [pair, count] : accuracy.confusion) overlaps.push_back({count, pair});
  std::ranges::sort(overlaps, std::ranges::greater());
  for (const auto& [count, pair] : overlaps) matches.add(pair.second, pair.first);
  const bool keeps_numbers = std::ranges::all_of(
      matches.pairs(), [](const auto& pair) { return pair.first == pair.second; });
  return {matches.pairs(), matches.pairs().size() > named && !keeps_numbers};
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

std::optional<double> LabelQuality::thin_overlap() const {
  double sum = 0;
  int count = 0;
  for (const auto& [label, pixels] : thin) {
    std::int64_t own = 0;
    for (const auto& [pair, given] : all.confusion) own += pair.first == label ? given : 0;
    if (2 * pixels <= own) continue;
    sum += all.overlap(label).value_or(0);
    ++count;
  }
  if (count == 0) return std::nullopt;
  return sum / count;
}

LabelQuality& LabelQuality::operator+=(const LabelQuality& other) {
  all += other.all;
  boundaries += other.boundaries;
  for (const auto& [label, pixels] : other.thin) thin[label] += pixels;
  return *this;
}

LabelQuality judge_label_quality(ImageView<const std::int32_t> labels,
                                 ImageView<const std::int32_t> truth) {
  LabelQuality quality;
  quality.all = judge_labels(labels, truth);
  const Image<std::uint8_t> near = near_boundaries(truth, kBoundaryBand_px);
  const Image<std::uint8_t> thin = thin_parts(truth);
  Image<std::int32_t> banded(truth.height, truth.width);
  for (int y = 0; y < truth.height; ++y) {
    for (int x = 0; x < truth.width; ++x) {
      const std::int32_t label = truth.at(y, x);
      if (near.at(y, x) != 0) banded.at(y, x) = label;
      if (label > 0 && thin.at(y, x) != 0) ++quality.thin[label];
    }
  }
  quality.boundaries = judge_labels(labels, banded.view());
  return quality;
}

LabelQuality judge_label_quality(const ViewStack<std::int32_t>& labels,
                                 const ViewStack<std::int32_t>& truth, const Progress& progress) {
  std::vector<LabelQuality> parts(static_cast<std::size_t>(labels.grid().count()));
  parallel_for(labels.grid().count(), progress, [&](int i) {
    const ViewIndex view = labels.view_at(i);
    if (truth.empty() || !truth.contains(view)) return;
    parts[static_cast<std::size_t>(i)] = judge_label_quality(labels.view(view), truth.view(view));
  });
  LabelQuality quality;
  for (const LabelQuality& part : parts) quality += part;
  return quality;
}

}  // namespace episcope
