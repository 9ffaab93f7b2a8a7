// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/formats/mosaic_periods.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <variant>
#include <vector>

namespace episcope::io {
namespace {

constexpr int kMostLines = 400;

/// Not a multiple of the distance of two lines, or all of them would show the same part of
/// lenslets.
int spread(int line, int lines, int length) {
  return static_cast<int>((line + 0.5) * length / lines);
}

template <class T>
float brightness(const T* pixel, int channels) {
  float sum = 0;
  for (int c = 0; c < channels; ++c) sum += static_cast<float>(pixel[c]);
  return sum / static_cast<float>(channels);
}

}  // namespace

Image<float> picture_lines(const AnyImage& picture, LineAxis axis) {
  return std::visit(
      [axis](const auto& image) {
        const int across = axis == LineAxis::X ? image.height() : image.width();
        const int along = axis == LineAxis::X ? image.width() : image.height();
        Image<float> lines(std::min(across, kMostLines), along);
        // Row by row of the picture in both cases, as it lies in memory.
        for (int i = 0; i < (axis == LineAxis::X ? lines.height() : along); ++i) {
          const auto* row = image.row(axis == LineAxis::X ? spread(i, lines.height(), across) : i);
          for (int k = 0; k < (axis == LineAxis::X ? along : lines.height()); ++k) {
            const int x = axis == LineAxis::X ? k : spread(k, lines.height(), across);
            const float value = brightness(row + x * image.channels(), image.channels());
            (axis == LineAxis::X ? lines.at(i, k) : lines.at(k, i)) = value;
          }
        }
        return lines;
      },
      picture);
}

namespace {

constexpr int kSmallestPeriod = 3;
constexpr int kLargestPeriod = 32;
/// Fewer repetitions of a period prove nothing.
constexpr int kFewestRepetitions = 8;
constexpr double kExplained = 0.5;
constexpr double kJump = 1.5;
/// A period is taken before its multiples, which explain as much.
constexpr double kAlmost = 0.9;
/// Of JPEG, in px; with colors of half the size, they are twice as large.
constexpr int kJpegBlock = 8;

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
  return is_likely() && (period_px % kJpegBlock != 0 || shading >= kExplained);
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

namespace {

constexpr int kMostTiles = 32;
constexpr int kLargestTileShift = 8;
constexpr int kStepWindow = 4;
constexpr int kLineStep = 2;
constexpr double kCorrelation = 0.3;
constexpr double kEdge = 1.5;

/// Differences of the means of neighboring windows of 4 px: what disparity moves by a pixel or two
/// still correlates.
Image<float> smooth_changes(const Image<float>& lines) {
  const int width = std::max(lines.width() - 2 * kStepWindow + 1, 1);
  Image<float> changes((lines.height() + kLineStep - 1) / kLineStep, width);
  if (lines.width() < 2 * kStepWindow) return changes;
  for (int y = 0; y < changes.height(); ++y) {
    const float* line = lines.row(y * kLineStep);
    for (int x = 0; x < width; ++x) {
      float change = 0;
      for (int i = 0; i < kStepWindow; ++i) change += line[x + kStepWindow + i] - line[x + i];
      changes.at(y, x) = change;
    }
  }
  return changes;
}

double correlation_at(const Image<float>& changes, int lag) {
  double ab = 0;
  double aa = 0;
  double bb = 0;
  for (int y = 0; y < changes.height(); ++y) {
    const float* a = changes.row(y);
    const float* b = a + lag;
    float row_ab = 0;
    float row_aa = 0;
    float row_bb = 0;
    for (int x = 0; x < changes.width() - lag; ++x) {
      row_ab += a[x] * b[x];
      row_aa += a[x] * a[x];
      row_bb += b[x] * b[x];
    }
    ab += row_ab;
    aa += row_aa;
    bb += row_bb;
  }
  const double norm = std::sqrt(aa * bb);
  return norm > 0 ? ab / norm : 0;
}

double edge_ratio(const Image<float>& lines, int tiles) {
  const int width = lines.width() / tiles;
  double all = 0;
  double edges = 0;
  for (int y = 0; y < lines.height(); ++y) {
    const float* line = lines.row(y);
    for (int x = 1; x < lines.width(); ++x) {
      const double difference = std::abs(line[x] - line[x - 1]);
      all += difference;
      if (x % width == 0) edges += difference;
    }
  }
  if (all <= 0) return 0;
  return edges / (tiles - 1) / (all / (lines.width() - 1));
}

/// Of tiles of `width` px and their neighbors, at the best of the shifts.
double tile_correlation(const Image<float>& changes, int width) {
  double best = 0;
  for (int shift = -kLargestTileShift; shift <= kLargestTileShift; ++shift) {
    best = std::max(best, correlation_at(changes, width + shift));
  }
  return best;
}

}  // namespace

bool TileCount::is_certain() const {
  return count > 1 && correlation >= kCorrelation && edge >= kEdge;
}

TileCount tiles_of_count(const Image<float>& lines, int count) {
  const int width = count > 1 ? lines.width() / count : 0;
  if (width <= kLargestTileShift || lines.width() % count != 0) return {};
  return {count, tile_correlation(smooth_changes(lines), width), edge_ratio(lines, count)};
}

TileCount find_tile_count(const Image<float>& lines) {
  const Image<float> changes = smooth_changes(lines);
  TileCount best;
  for (int tiles = 2; tiles <= kMostTiles; ++tiles) {
    const int width = lines.width() / tiles;
    if (lines.width() % tiles != 0 || width < kSmallestTile) continue;
    const double correlation = tile_correlation(changes, width);
    if (correlation > best.correlation) best = {tiles, correlation, 0};
  }
  if (best.count > 0) best.edge = edge_ratio(lines, best.count);
  return best;
}

}  // namespace episcope::io
