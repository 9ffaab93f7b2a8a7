// SPDX-License-Identifier: BSD-3-Clause
#include "engine/evaluation/metrics/label_quality.h"

#include "engine/core/parallel/parallel.h"

#include <algorithm>
#include <vector>

namespace episcope {
namespace {

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

}  // namespace

Image<std::uint8_t> near_boundaries(ImageView<const std::int32_t> labels, int radius) {
  const auto least = over_windows(labels, radius, [](auto a, auto b) { return std::min(a, b); });
  const auto most = over_windows(labels, radius, [](auto a, auto b) { return std::max(a, b); });
  Image<std::uint8_t> near(labels.height, labels.width);
  std::transform(least.begin(), least.end(), most.begin(), near.begin(),
                 [](auto a, auto b) { return static_cast<std::uint8_t>(a != b); });
  return near;
}

Image<std::uint8_t> thin_parts(ImageView<const std::int32_t> labels) {
  // A square without a boundary covers all of its pixels.
  const Image<std::uint8_t> mixed = near_boundaries(labels, kThinWidth_px / 2);
  const ImageView<const std::uint8_t> view = mixed.view();
  return over_windows(view, kThinWidth_px / 2, [](auto a, auto b) { return std::min(a, b); });
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
