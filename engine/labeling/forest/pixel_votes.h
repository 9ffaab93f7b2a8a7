// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/array/large_memory.h"
#include "engine/core/array/volume.h"
#include "engine/core/parallel/progress.h"
#include "engine/cuda/forest/forest_votes.h"
#include "engine/labeling/forest/forest.h"

namespace episcope {

/// The votes of a forest for all pixels of one view, counted here or on the GPU, with the same
/// bits. 4·pitch bytes per pixel.
class PixelVotes {
 public:
  /// `features` `[y][feature][x]` as the forest was trained on. Throws Cancelled.
  PixelVotes(const Forest& forest, VolumeView<const float> features, const Progress& progress);
  /// On the GPU. Throws DeviceFailure, Cancelled.
  PixelVotes(const Forest& forest, VolumeView<const float> features,
             const cuda::DeviceForest& device, const Progress& progress);

  [[nodiscard]] int height() const { return height_; }
  [[nodiscard]] int width() const { return width_; }
  [[nodiscard]] int label_count() const { return label_count_; }
  /// Floats of a pixel in a row.
  [[nodiscard]] int pitch() const { return pitch_; }
  /// Votes of row `y`, `[x][label]`, `pitch()` apart, as Forest::predict_rows.
  [[nodiscard]] const float* row(int y) const { return votes_.get() + y * row_size(); }
  [[nodiscard]] std::ptrdiff_t row_size() const {
    return static_cast<std::ptrdiff_t>(width_) * pitch_;
  }

 private:
  PixelVotes(const Forest& forest, VolumeView<const float> features);

  int height_, width_, label_count_, pitch_;
  LargeArray<float> votes_;
};

}  // namespace episcope
