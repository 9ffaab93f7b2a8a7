// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/array/volume.h"
#include "engine/core/light_field/disparity_field.h"
#include "engine/core/light_field/scene.h"
#include "engine/core/parallel/isa.h"
#include "engine/core/parallel/progress.h"

#include <cstdint>
#include <vector>

namespace episcope {

/// The strokes of all painted views as one view sees them, `[y][x]`: an index of `ids` (ascending)
/// plus one, 0 = none. Strokes of other views are carried along the rays of `disparity`, where
/// their pixel is seen in the view (engine/labeling/rays/ray_targets.h); without disparity of both
/// views, they are left out.
[[nodiscard]] Image<std::int32_t> carried_strokes(const Scribbles& scribbles,
                                                  const std::vector<std::int32_t>& ids,
                                                  const DisparityField* disparity, ViewIndex view,
                                                  int height, int width);

/// How far each pixel of a view is from the strokes of each label.
class StrokeDistances {
 public:
  /// Shortest paths over the 8 neighbours of pixels: a step costs the Euclidean difference of the
  /// pixels' `guides` (planes `[y][x]`) plus kStep per pixel. Found by three raster sweeps in both
  /// directions: exact where the path turns seldom (Toivanen 1996; Criminisi et al. 2008, GeoS).
  /// Memory: 4 bytes per pixel and label. `strokes` as from `carried_strokes`. Throws Cancelled.
  StrokeDistances(ImageView<const std::int32_t> strokes, int label_count,
                  const std::vector<ImageView<const float>>& guides, const Progress& progress,
                  Isa isa = best_isa());

  static constexpr float kStep = 0.0015F;

  /// By how much the pixel is farther from the strokes of a label than from the nearest ones of
  /// all, at most kMaxExcess; 0 for labels without a stroke in the view.
  [[nodiscard]] float excess(int y, int x, int label) const;
  static constexpr float kMaxExcess = 12;

  /// Multiplies the probabilities of row `y`, `[x][label]`, `pitch` apart, by
  /// exp(−strength·excess), and makes them sum to 1 again.
  void weigh_row(int y, double strength, int pitch, float* probabilities) const;

 private:
  void find_ways(const std::vector<ImageView<const float>>& guides);
  void sweep(const Progress& progress, Isa isa);

  int height_;
  int width_;
  int label_count_;
  int pitch_;
  LargeArray<float> distances_;  // [y][x][label]
  std::vector<float> ways_[4];
  std::vector<int> stroked_;  // Labels with a stroke.
};

}  // namespace episcope
