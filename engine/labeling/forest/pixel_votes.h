// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/array/volume.h"
#include "engine/core/parallel/progress.h"
#include "engine/cuda/forest/forest_votes.h"
#include "engine/labeling/forest/forest.h"

#include <vector>

namespace episcope {

/// The votes of a forest for the pixels of one view: counted row by row as they are asked for, or
/// for all of them at once, here or on the GPU, with the same bits. Borrows forest and features.
class PixelVotes {
 public:
  /// `features` `[y][feature][x]` as the forest was trained on.
  PixelVotes(const Forest& forest, VolumeView<const float> features);
  /// All of them on the GPU, now. Throws DeviceFailure, Cancelled.
  PixelVotes(const Forest& forest, VolumeView<const float> features,
             const cuda::DeviceForest& device, const Progress& progress);

  [[nodiscard]] int height() const { return features_.height; }
  [[nodiscard]] int width() const { return features_.width; }
  [[nodiscard]] int label_count() const { return forest_.label_count(); }
  /// Counts all of them now and keeps them, if that was not done: for who asks more than once.
  /// 4·pitch bytes per pixel. Throws Cancelled.
  void count_all(const Progress& progress);

  /// Floats of a pixel in a row.
  [[nodiscard]] int pitch() const { return forest_.pitch(); }
  /// Votes of row `y`, `[x][label]`, `pitch()` apart, as Forest::predict_row.
  void row(int y, float* out) const;

 private:
  const Forest& forest_;
  VolumeView<const float> features_;
  std::vector<float> counted_;  // Of all rows; empty = none yet.
};

}  // namespace episcope
