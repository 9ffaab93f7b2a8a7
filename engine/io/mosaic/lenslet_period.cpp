// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/mosaic/lenslet_period.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

namespace episcope::io {
namespace {

constexpr int kSmallestPeriod = 3;
constexpr int kLargestPeriod = 32;
/// Fewer repetitions of a period prove nothing.
constexpr int kFewestRepetitions = 8;
constexpr double kExplained = 0.5;
constexpr double kJump = 1.5;
/// A period is taken before its multiples, which explain as much.
constexpr double kAlmost = 0.9;
/// Of JPEG, in px; with colours of half the size, they are twice as large.
constexpr int kBlock = 8;

struct Folded {
  double explained = 0;
  double jump = 0;
};

/// Each period divided by its mean, so that only what is within periods counts.
Folded fold(const std::vector<double>& signal, int period) {
  const std::size_t repetitions = signal.size() / static_cast<std::size_t>(period);
  if (repetitions < kFewestRepetitions) return {};
  std::vector<double> mean(static_cast<std::size_t>(period));
  double total = 0;
  for (std::size_t r = 0; r < repetitions; ++r) {
    const auto begin = signal.begin() + static_cast<std::ptrdiff_t>(r) * period;
    const double level = std::accumulate(begin, begin + period, 0.0) / period;
    if (level <= 0) continue;
    for (int i = 0; i < period; ++i) {
      const double relative = begin[i] / level - 1;
      total += relative * relative;
      mean[static_cast<std::size_t>(i)] += relative / static_cast<double>(repetitions);
    }
  }
  double repeated = 0;
  for (const double value : mean) repeated += static_cast<double>(repetitions) * value * value;
  std::vector<double> sorted = mean;
  std::ranges::sort(sorted);
  const double median = 1 + sorted[sorted.size() / 2];
  return {total > 0 ? repeated / total : 0, median > 0 ? (1 + sorted.back()) / median : 0};
}

}  // namespace

bool LensletPeriod::is_likely() const {
  return period_px > 0 && explained >= kExplained && jump >= kJump;
}

bool LensletPeriod::is_likely_in_jpeg() const {
  return is_likely() && (period_px % kBlock != 0 || shading >= kExplained);
}

bool LensletPeriod::is_certain() const {
  return is_likely() && (period_px % 4 != 0 || shading >= kExplained);
}

LensletPeriod find_lenslet_period(const Image<float>& lines) {
  std::vector<double> brightness(static_cast<std::size_t>(lines.width()));
  std::vector<double> difference(static_cast<std::size_t>(std::max(lines.width() - 1, 0)));
  for (int y = 0; y < lines.height(); ++y) {
    const float* line = lines.row(y);
    for (std::size_t x = 0; x < brightness.size(); ++x) brightness[x] += line[x];
    for (std::size_t x = 0; x < difference.size(); ++x) {
      difference[x] += std::abs(line[x + 1] - line[x]);
    }
  }
  std::vector<Folded> folded;
  for (int period = kSmallestPeriod; period <= kLargestPeriod; ++period) {
    folded.push_back(fold(difference, period));
  }
  const double best = std::ranges::max(folded, {}, &Folded::explained).explained;
  const auto found = std::ranges::find_if(
      folded, [best](const Folded& one) { return one.explained >= kAlmost * best; });
  if (best <= 0) return {};
  const int period = kSmallestPeriod + static_cast<int>(found - folded.begin());
  return {period, found->explained, found->jump, fold(brightness, period).explained};
}

}  // namespace episcope::io
