// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/image.h"
#include "engine/core/indices.h"
#include "engine/core/progress.h"
#include "engine/core/view_stack.h"

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace episcope::cuda {

/// What is known of one view; borrowed. Maps may be null, of all views or of none.
struct RayView {
  VolumeView<const std::uint8_t> probabilities;  ///< `[y][label][x]`, at most 256 labels.
  const float* weights = nullptr;                ///< Of boundaries, `[y][x]`; null = 1.
  const float* disparity = nullptr;              ///< `[y][x]`; null = rays are not followed.
  const std::uint8_t* valid = nullptr;           ///< Of disparity; null = everywhere.
  const std::uint8_t* colors = nullptr;  ///< `[y][x][channel]`; null = all rays are trusted.
  /// Label of each pixel that keeps it, `[y][x]`, −1 = free; null, also of some views alone = all
  /// are free.
  const std::int32_t* painted = nullptr;
};

/// All views of a rectangle of the camera grid, and how they are labeled (RayLabelingParameters).
struct RayLabelsTask {
  GridShape grid;
  std::vector<RayView> views;  ///< `[v][u]`
  int channels = 0;            ///< Of the colors.
  /// Views that are solved one after the other, numbers of `views`, each from where the one before
  /// ended, if disparities are known. Longer ones come first.
  std::vector<std::vector<int>> chains;
  std::span<const float> costs;   ///< Of each probability, 256.
  std::span<const float> trusts;  ///< Of each squared difference of colors; the last: of all above.
  float tolerance_px = 0;         ///< Disparities within count as the same point.
  int near_views = 0;  ///< Rays of the nearest n×n views share their costs; 0 = each has its own.
  int votes = 0;       ///< Rounds in which the rays of a point vote.
  double smoothness = 1;    ///< > 0
  float price_of_held = 0;  ///< Of another label of a pixel that keeps its own.
  double gap = 1e-2;
  int max_iterations = 300;
  int check_every = 5;
  int racing_iterations = 0;  ///< As in SimplexOptions.
};

/// Sums over the views, and the most iterations of any.
struct RayLabelsAnswer {
  double energy = 0, bound = 0;
  int iterations = 0;
};

/// Writes the labels of all views, 0 … L − 1, as Regularizer::Rayspace and ::View
/// (engine/labeling/rays) do on the CPU; there must be two or more labels. Throws DeviceFailure,
/// Cancelled.
[[nodiscard]] RayLabelsAnswer label_rays(const RayLabelsTask& task, const Progress& progress,
                                         ViewStack<std::int32_t>& labels);

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
