// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/mosaic/tile_count.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace episcope::io {
namespace {

constexpr int kMostTiles = 32;
constexpr int kSmallestTile = 32;
constexpr int kLargestShift = 8;
constexpr int kWindow = 4;
constexpr int kLineStep = 2;
constexpr double kCorrelation = 0.3;
constexpr double kEdge = 1.5;

/// Differences of the means of neighbouring windows of 4 px: what disparity moves by a pixel or two
/// still correlates.
Image<float> smooth_changes(const Image<float>& lines) {
  const int width = std::max(lines.width() - 2 * kWindow + 1, 1);
  Image<float> changes((lines.height() + kLineStep - 1) / kLineStep, width);
  if (lines.width() < 2 * kWindow) return changes;
  for (int y = 0; y < changes.height(); ++y) {
    const float* line = lines.row(y * kLineStep);
    for (int x = 0; x < width; ++x) {
      float change = 0;
      for (int i = 0; i < kWindow; ++i) change += line[x + kWindow + i] - line[x + i];
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

}  // namespace

bool TileCount::is_certain() const {
  return count > 1 && correlation >= kCorrelation && edge >= kEdge;
}

TileCount find_tile_count(const Image<float>& lines) {
  const Image<float> changes = smooth_changes(lines);
  TileCount best;
  for (int tiles = 2; tiles <= kMostTiles; ++tiles) {
    const int width = lines.width() / tiles;
    if (lines.width() % tiles != 0 || width < kSmallestTile) continue;
    for (int shift = -kLargestShift; shift <= kLargestShift; ++shift) {
      const double correlation = correlation_at(changes, width + shift);
      if (correlation > best.correlation) best = {tiles, correlation, 0};
    }
  }
  if (best.count > 0) best.edge = edge_ratio(lines, best.count);
  return best;
}

}  // namespace episcope::io
