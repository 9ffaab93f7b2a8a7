// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "annotation/scribble_layer.h"
#include "engine/core/disparity_field.h"
#include "engine/core/image.h"
#include "engine/core/indices.h"

#include <cstdint>

namespace episcope {

/// Tells which pixels of a view are like another one, for fills.
class Likeness {
 public:
  /// Neighbors whose disparities differ by more belong to different surfaces, px.
  static constexpr float kJump_px = 0.25F;

  /// `picture` is `[y][x][c]` in [0, 1]; `disparity` of the view, or empty.
  Likeness(ImageView<const float> picture, const DisparityView& disparity);

  /// The unit of tolerances: how much neighboring pixels of this picture differ in the median, as a
  /// Euclidean norm over the channels, at least one of 255 levels.
  [[nodiscard]] float noise() const { return noise_; }
  /// Pixels connected to `seed` by their sides whose smoothed colors differ from its own by at most
  /// `tolerance` · noise, without a jump of disparity between them. Single pixels that it encloses
  /// belong to it. It has the seed itself at least; empty if that lies outside. Throws InvalidInput
  /// for a negative tolerance.
  [[nodiscard]] PixelRegion region(PixelIndex seed, double tolerance) const;

 private:
  Image<float> colors_;        // smoothed
  Image<std::uint8_t> jumps_;  // 1 = beside a jump of disparity; empty = none
  float noise_;
};

}  // namespace episcope
