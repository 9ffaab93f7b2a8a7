// SPDX-License-Identifier: BSD-3-Clause
// Compiled once for each instruction set: see engine/core/parallel/isa.h for what may stand here.
#include "engine/labeling/forest/forest_kernel.h"

#include "engine/core/parallel/simd.h"

namespace episcope::EPISCOPE_KERNEL_NAMESPACE {
namespace {

// Pixels walked in lockstep: enough independent loads to hide their latency.
constexpr int kGroup = 16;

// Leads a group of pixels to their leaves. Scalar on purpose: each step is two dependent loads from
// the first-level cache, which the processor overlaps over the group; gathers of the vector units
// are slower.
inline void walk(const ForestNode* tree, const float* features, long stride, int* node) {
  for (int i = 0; i < kGroup; ++i) node[i] = 0;
  int moved;
  do {
    moved = 0;
    for (int i = 0; i < kGroup; ++i) {
      const ForestNode at = tree[node[i]];
      const int next = at.next + (features[at.feature * stride + i] > at.threshold ? 1 : 0);
      moved |= next ^ node[i];
      node[i] = next;
    }
  } while (moved != 0);
}

void vote(const FlatForest& forest, const float* features, long stride, int count, float* sums) {
  for (int i = 0; i < count * forest.pitch; i += kLanes) store(sums + i, Vec{});
  int node[kGroup];
  for (int t = 0; t < forest.tree_count; ++t) {
    const int root = forest.roots[t];
    for (int x = 0; x < count; x += kGroup) {
      walk(forest.nodes + root, features + x, stride, node);
      const int end = count - x < kGroup ? count - x : kGroup;
      for (int i = 0; i < end; ++i) {
        const float* votes =
            forest.votes + static_cast<long>(forest.votes_of[root + node[i]]) * forest.pitch;
        float* sum = sums + (x + i) * static_cast<long>(forest.pitch);
        for (int l = 0; l < forest.pitch; l += kLanes)
          store(sum + l, load(sum + l) + load(votes + l));
      }
    }
  }
}

}  // namespace

const ForestKernel kForestKernel = {vote};

}  // namespace episcope::EPISCOPE_KERNEL_NAMESPACE
