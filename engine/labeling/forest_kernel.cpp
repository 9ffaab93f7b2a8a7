// SPDX-License-Identifier: BSD-3-Clause
#include "engine/labeling/forest_kernel.h"

#include "engine/core/simd.h"

// Compiled once for each instruction set: see engine/core/isa.h for what may stand here.

namespace episcope::EPISCOPE_KERNEL_NAMESPACE {
namespace {

// Pixels of a block, a bit each.
using Pixels = unsigned long long;
static_assert(kForestBlock == 64);

// So few pixels are led to their leaves one by one.
constexpr int kFew = 4;

struct Tree {
  const FlatForest& forest;
  int root;
  const float* features;
  long stride;
  float* sums;
};

inline void add_votes(const Tree& tree, int node, int pixel) {
  const long pitch = tree.forest.pitch;
  const float* const votes = tree.forest.votes + tree.forest.votes_of[tree.root + node] * pitch;
  float* const sum = tree.sums + pixel * pitch;
  for (long l = 0; l < pitch; l += kLanes) store(sum + l, load(sum + l) + load(votes + l));
}

// In lockstep: their loads do not wait for each other.
inline void walk(const Tree& tree, int from, Pixels pixels) {
  const ForestNode* const nodes = tree.forest.nodes + tree.root;
  int pixel[kFew] = {}, node[kFew], count = 0;
  for (; pixels != 0; pixels &= pixels - 1) pixel[count++] = __builtin_ctzll(pixels);
  for (int i = 0; i < kFew; ++i) {
    node[i] = from;
    if (i >= count) pixel[i] = pixel[0];
  }
  int moved;
  do {
    moved = 0;
    for (int i = 0; i < kFew; ++i) {
      const ForestNode at = nodes[node[i]];
      const int next =
          at.next + (tree.features[at.feature * tree.stride + pixel[i]] > at.threshold ? 1 : 0);
      moved |= next ^ node[i];
      node[i] = next;
    }
  } while (moved != 0);
  for (int i = 0; i < count; ++i) add_votes(tree, node[i], pixel[i]);
}

inline Pixels above(const float* feature, float threshold) {
  Pixels found = 0;
  for (int i = 0; i < kForestBlock; i += kLanes) {
    found |= static_cast<Pixels>(lanes_of(load(feature + i) > threshold)) << i;
  }
  return found;
}

// Neighboring pixels mostly go the same way: a node is looked at once for all that arrive there.
void lead(const Tree& tree, int node, Pixels pixels) {
  for (;;) {
    const ForestNode at = tree.forest.nodes[tree.root + node];
    if (at.next == node) {
      for (; pixels != 0; pixels &= pixels - 1) add_votes(tree, node, __builtin_ctzll(pixels));
      return;
    }
    if (__builtin_popcountll(pixels) <= kFew) return walk(tree, node, pixels);
    const Pixels up = pixels & above(tree.features + at.feature * tree.stride, at.threshold);
    if (up == 0) {
      node = at.next;
      continue;
    }
    if (up != pixels) lead(tree, at.next, pixels & ~up);
    node = at.next + 1;
    pixels = up;
  }
}

void vote(const FlatForest& forest, const float* features, long stride, int count, float* sums) {
  for (int i = 0; i < count * forest.pitch; i += kLanes) store(sums + i, Vec{});
  const Pixels all = ~Pixels{0} >> (kForestBlock - count);
  for (int t = 0; t < forest.tree_count; ++t) {
    lead({forest, forest.roots[t], features, stride, sums}, 0, all);
  }
}

}  // namespace

const ForestKernel kForestKernel = {vote};

}  // namespace episcope::EPISCOPE_KERNEL_NAMESPACE
