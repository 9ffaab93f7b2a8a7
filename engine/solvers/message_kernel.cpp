// SPDX-License-Identifier: BSD-3-Clause
#include "engine/solvers/message_kernel.h"

#include "engine/core/simd.h"

// Compiled once for each instruction set: see engine/core/isa.h for what may stand here.

namespace episcope::EPISCOPE_KERNEL_NAMESPACE {
namespace {

constexpr float kFar = 1e30F;
constexpr int kMargin = kMostMessageLabels;

// A row of labels with room beside it for whatever a shift reaches.
struct Row {
  float memory[kMostMessageLabels + 2 * kMargin];
  float* begin() { return memory + kMargin; }
  void close(int labels, int reach) {
    for (int i = 1; i <= reach; ++i) {
      begin()[-i] = kFar;
      begin()[labels + i - 1] = kFar;
    }
  }
};

inline float least_of(Vec value) {
  float all = value[0];
  for (int i = 1; i < kLanes; ++i) all = value[i] < all ? value[i] : all;
  return all;
}

// Costs and messages at every label; returns the least sum.
float add_up(const MessagePixel& pixel, float* sums) {
  Vec low = splat(kFar);
  for (int l = 0; l < pixel.labels; l += kLanes) {
    Vec sum = load(pixel.costs + l);
    for (const float* const message : pixel.received) {
      if (message) sum += load(message + l);
    }
    store(sums + l, sum);
    low = least(low, sum);
  }
  return least_of(low);
}

// The first shift that no difference below the truncation needs.
inline int reach_of(const MessagePixel& pixel) {
  int reach = 1;
  while (reach < pixel.labels && pixel.slope * static_cast<float>(2 * reach - 1) < pixel.most) {
    reach *= 2;
  }
  return reach;
}

// out(k) = min_j in(j) + weight·slope·|j − k| for |j − k| < 2·reach, by shifts of 1, 2, 4 …
float* spread(const MessagePixel& pixel, float weight, int reach, Row& a, Row& b) {
  Row *from = &a, *to = &b;
  for (int shift = 1; shift <= reach; shift *= 2) {
    const Vec cost = splat(weight * pixel.slope * static_cast<float>(shift));
    const float* const in = from->begin();
    float* const out = to->begin();
    for (int l = 0; l < pixel.labels; l += kLanes) {
      const Vec beside = least(load(in + l - shift), load(in + l + shift));
      store(out + l, least(load(in + l), beside + cost));
    }
    Row* const next = from;
    from = to;
    to = next;
  }
  return from->begin();
}

float pass(const MessagePixel& pixel) {
  Row sums, a, b;
  const float low = add_up(pixel, sums.begin());
  const int reach = reach_of(pixel);
  a.close(pixel.labels, reach);
  b.close(pixel.labels, reach);
  float gain = low;
  for (const MessageEdge& edge : pixel.passed) {
    if (!edge.message) continue;
    Vec least_kept = splat(kFar);
    const Vec share = splat(pixel.share), lowest = splat(low);
    for (int l = 0; l < pixel.labels; l += kLanes) {
      const Vec kept = share * (load(sums.begin() + l) - lowest) - load(edge.message + l);
      store(a.begin() + l, kept);
      least_kept = least(least_kept, kept);
    }
    const float base = least_of(least_kept);
    const float* const reached = spread(pixel, edge.weight, reach, a, b);
    const Vec limit = splat(edge.weight * pixel.most), zero = splat(base);
    for (int l = 0; l < pixel.labels; l += kLanes) {
      store(edge.message + l, least(load(reached + l) - zero, limit));
    }
    gain += base;
  }
  return gain;
}

int choose_label(const MessagePixel& pixel, const int neighbours[2], const float weights[2]) {
  Row sums;
  float* const sum = sums.begin();
  add_up(pixel, sum);
  for (int i = 0; i < 2; ++i) {
    if (neighbours[i] < 0) continue;
    for (int l = 0; l < pixel.labels; ++l) {
      const auto off =
          static_cast<float>(l < neighbours[i] ? neighbours[i] - l : l - neighbours[i]);
      const float cost = pixel.slope * off;
      sum[l] += weights[i] * (cost < pixel.most ? cost : pixel.most);
    }
  }
  int best = 0;
  for (int l = 1; l < pixel.labels; ++l) best = sum[l] < sum[best] ? l : best;
  return best;
}

}  // namespace

extern const MessageKernel kMessageKernel;
const MessageKernel kMessageKernel{pass, choose_label};

}  // namespace episcope::EPISCOPE_KERNEL_NAMESPACE
