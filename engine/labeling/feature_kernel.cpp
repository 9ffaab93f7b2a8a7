// SPDX-License-Identifier: BSD-3-Clause
#include "engine/labeling/feature_kernel.h"

#include "engine/core/simd.h"

// Compiled once for each instruction set: see engine/core/isa.h for what may stand here.

namespace episcope::EPISCOPE_KERNEL_NAMESPACE {
namespace {

constexpr float kPerPower = 1.44269504F;  // log2 e

void misfits(const SurfaceRow& row, float* out) {
  for (int x = 0; x < row.width; ++x, out += row.pitch) {
    const float disparity = row.disparity[x];
    for (int l = 0; l < row.pitch; l += kLanes) {
      const Vec dx = static_cast<float>(x) - load(row.middle + l);
      const Vec spread = load(row.flat + l) + (load(row.slope + l) + load(row.bend + l) * dx) * dx;
      const Vec variance = load(row.variance + l) * (spread + 1.0F);
      const Vec miss = disparity - load(row.at + l) - load(row.across + l) * dx;
      const Vec all = variance + miss * miss;
      const Vec misfit = 0.5F * natural_log(all * all / (variance * row.noise));
      const IntVec is_known = load(row.is_known + l) > 0.0F;
      store(out + l, choose(is_known, least(misfit, splat(row.most)), splat(0.5F * row.most)));
    }
  }
}

inline float least_of(const float* values, int count) {
  Vec all = load(values);
  for (int i = kLanes; i < count; i += kLanes) all = least(all, load(values + i));
  float found = all[0];
  for (int i = 1; i < kLanes; ++i) found = all[i] < found ? all[i] : found;
  return found;
}

void weigh(const WeighedRow& row, float* p) {
  const float* against = row.against;
  for (int x = 0; x < row.width; ++x, p += row.pitch, against += row.pitch) {
    const float best = least_of(against, row.pitch);
    const float power = -kPerPower * row.strength[x];
    Vec sums{};
    for (int l = 0; l < row.pitch; l += kLanes) {
      const Vec excess = least(load(against + l) - best, splat(row.most));
      const Vec weight = power_of_two(power * (excess * load(row.is_weighed + l)));
      const Vec value = (load(p + l) + load(row.floor + l)) * weight;
      store(p + l, value);
      sums += value;
    }
    float sum = 0;
    for (int i = 0; i < kLanes; ++i) sum += sums[i];
    if (!(sum > 0)) continue;
    for (int l = 0; l < row.pitch; l += kLanes) store(p + l, load(p + l) / sum);
  }
}

// Pixels wait for their neighbors along x, so the vectors run over the labels.
inline void shorten(const DistanceGrid& grid, long to, long from, float way) {
  float* own = grid.distances + to * grid.pitch;
  const float* other = grid.distances + from * grid.pitch;
  const Vec length = splat(way);
  for (int l = 0; l < grid.pitch; l += kLanes) {
    store(own + l, least(load(own + l), load(other + l) + length));
  }
}

void sweep_down(const DistanceGrid& grid, int y) {
  const long width = grid.width;
  for (long x = 0, i = y * width; x < width; ++x, ++i) {
    if (x > 0) shorten(grid, i, i - 1, grid.ways[0][i - 1]);
    if (y == 0) continue;
    shorten(grid, i, i - width, grid.ways[1][i - width]);
    if (x > 0) shorten(grid, i, i - width - 1, grid.ways[2][i - width - 1]);
    if (x + 1 < width) shorten(grid, i, i - width + 1, grid.ways[3][i - width + 1]);
  }
}

void sweep_up(const DistanceGrid& grid, int y) {
  const long width = grid.width;
  for (long x = width - 1, i = y * width + x; x >= 0; --x, --i) {
    if (x + 1 < width) shorten(grid, i, i + 1, grid.ways[0][i]);
    if (y + 1 == grid.height) continue;
    shorten(grid, i, i + width, grid.ways[1][i]);
    if (x + 1 < width) shorten(grid, i, i + width + 1, grid.ways[2][i]);
    if (x > 0) shorten(grid, i, i + width - 1, grid.ways[3][i]);
  }
}

inline Vec magnitude(Vec value) {
  return reinterpret_cast<Vec>(reinterpret_cast<IntVec>(value) & 0x7FFFFFFF);
}

void filter(const SurfaceTaps& taps, float* const* out) {
  for (int x = 0; x < taps.width; x += kLanes) {
    const float* const from[3] = {taps.channels[0] + x, taps.channels[1] + x, taps.channels[2] + x};
    const Vec own[3] = {load(from[0]), load(from[1]), load(from[2])};
    Vec sum[3] = {};
    Vec all{};
    for (int t = 0; t < taps.count; ++t) {
      const long at = taps.offsets[t];
      const Vec a = load(from[0] + at), b = load(from[1] + at), c = load(from[2] + at);
      const Vec difference = magnitude(a - own[0]) + magnitude(b - own[1]) + magnitude(c - own[2]);
      const Vec weight = power_of_two(taps.nearness[t] - taps.contrast * difference * difference);
      sum[0] += weight * a;
      sum[1] += weight * b;
      sum[2] += weight * c;
      all += weight;
    }
    for (int c = 0; c < 3; ++c) store(out[c] + x, sum[c] / all);
  }
}

}  // namespace

const LabelWeightsKernel kLabelWeightsKernel = {misfits, weigh};

const StrokeDistanceKernel kStrokeDistanceKernel = {sweep_down, sweep_up};

const SurfaceKernel kSurfaceKernel = {filter};

}  // namespace episcope::EPISCOPE_KERNEL_NAMESPACE
