// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/isa.h"

namespace episcope {

/// A node of a flattened tree. A pixel continues at node `next + (value > threshold)` of the tree;
/// a leaf has an infinite threshold and leads to itself.
struct ForestNode {
  float threshold;
  unsigned short feature;
  unsigned short next;
};

/// Floats in the widest vector. Rows are padded to whole vectors of this length.
inline constexpr int kVectorLanes = 16;

/// Pixels that are led through a tree at once.
inline constexpr int kForestBlock = 64;

/// All trees as the kernel walks them.
struct FlatForest {
  const ForestNode* nodes = nullptr;
  const int* roots = nullptr;     ///< First node of each tree.
  const int* votes_of = nullptr;  ///< Row of `votes` for each node that is a leaf.
  const float* votes = nullptr;   ///< `[leaf][label]`, `pitch` apart, rows that sum to 1.
  int tree_count = 0;
  int node_count = 0, leaf_count = 0;
  int pitch = 0;  ///< Labels, rounded up to whole vectors of the widest kind.
};

/// The kernel's entry point, one for each instruction set.
struct ForestKernel {
  /// Adds up the votes of all trees for `count` ≤ kForestBlock pixels of a row whose features lie
  /// `stride` apart, into `sums` `[pixel][label]`, `pitch` apart.
  void (*vote)(const FlatForest&, const float* features, long stride, int count, float* sums);
};

EPISCOPE_DECLARE_KERNEL(extern const ForestKernel kForestKernel);

}  // namespace episcope
