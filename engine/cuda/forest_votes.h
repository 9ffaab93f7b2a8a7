// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/image.h"
#include "engine/core/progress.h"

#include <cstdint>
#include <memory>
#include <span>

namespace episcope::cuda {

/// A pixel moves to node `next + (value > threshold)` of its tree; a leaf leads to itself.
struct TreeNode {
  float threshold;
  std::uint16_t feature, next;
};

/// A flattened forest, borrowed: FlatForest of engine/labeling/forest_kernel.h.
struct ForestTables {
  std::span<const TreeNode> nodes;
  std::span<const int> roots;     ///< First node of each tree.
  std::span<const int> votes_of;  ///< Row of `votes` for each node that is a leaf.
  std::span<const float> votes;   ///< `[leaf][label]`, `pitch` apart.
  int pitch = 0;                  ///< A multiple of 4.
};

/// A forest on the device. May vote for several threads at once.
class DeviceForest {
 public:
  /// Copies the forest to the device. Throws DeviceFailure, Cancelled.
  DeviceForest(const ForestTables& forest, const Progress& progress);
  ~DeviceForest();
  DeviceForest(const DeviceForest&) = delete;
  DeviceForest& operator=(const DeviceForest&) = delete;

  /// The mean vote of all trees for every pixel of a view, `[y][x][label]`, `pitch` apart, into
  /// `votes`; `features` `[y][feature][x]`. The same bits as Forest::predict_rows. Throws
  /// DeviceFailure, Cancelled.
  void vote(VolumeView<const float> features, const Progress& progress, float* votes) const;

 private:
  struct Memory;
  std::unique_ptr<Memory> memory_;
};

}  // namespace episcope::cuda
