// SPDX-License-Identifier: BSD-3-Clause
#include "app/session/labels/label_statistics.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace episcope {
namespace {

struct Sums {
  std::int64_t pixels = 0;
  std::int64_t measured = 0;
  double sum = 0;
  double squares = 0;
  double min = std::numeric_limits<double>::infinity();
  double max = -std::numeric_limits<double>::infinity();

  void add(const DisparityView& disparity, int y, int x0, int x1) {
    pixels += x1 - x0;
    if (disparity.disparity.empty()) return;
    for (int x = x0; x < x1; ++x) {
      if (!disparity.is_valid(y, x)) continue;
      const double value = disparity.disparity.at(y, x);
      ++measured;
      sum += value;
      squares += value * value;
      min = std::min(min, value);
      max = std::max(max, value);
    }
  }

  [[nodiscard]] std::optional<LabelDisparity> disparity() const {
    if (measured == 0) return std::nullopt;
    const auto count = static_cast<double>(measured);
    const double mean = sum / count;
    return LabelDisparity{mean, std::sqrt(std::max(0.0, squares / count - mean * mean)), min, max};
  }
};

template <class Label>
std::vector<LabelAmount> amounts_of(ImageView<const Label> labels, const DisparityView& disparity) {
  std::map<std::int32_t, Sums> sums;
  for (int y = 0; y < labels.height; ++y) {
    const Label* row = labels.row(y);
    for (int x = 0; x < labels.width;) {
      const int begin = x;
      while (x < labels.width && row[x] == row[begin]) ++x;
      if (row[begin] > 0) sums[row[begin]].add(disparity, y, begin, x);
    }
  }
  std::vector<LabelAmount> amounts;
  for (const auto& [id, each] : sums) amounts.push_back({id, each.pixels, each.disparity()});
  return amounts;
}

}  // namespace

std::vector<LabelAmount> label_amounts(ImageView<const std::int32_t> labels,
                                       const DisparityView& disparity) {
  return amounts_of(labels, disparity);
}

std::vector<LabelAmount> label_amounts(ImageView<const std::uint8_t> labels,
                                       const DisparityView& disparity) {
  return amounts_of(labels, disparity);
}

}  // namespace episcope
