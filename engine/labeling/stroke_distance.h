// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/disparity_field.h"
#include "engine/core/isa.h"
#include "engine/core/progress.h"
#include "engine/core/scene.h"
#include "engine/core/volume.h"
#include "engine/labeling/label_surfaces.h"

#include <cstdint>
#include <vector>

namespace episcope {

/// The strokes of all painted views as one view sees them, `[y][x]`: an index of `ids` (ascending)
/// plus one, 0 = none. Strokes of other views are carried along the rays of `disparity`, where
/// their pixel is seen in the view (engine/labeling/ray_targets.h); without disparity of both
/// views, they are left out.
[[nodiscard]] Image<std::int32_t> carried_strokes(const Scribbles& scribbles,
                                                  const std::vector<std::int32_t>& ids,
                                                  const DisparityField* disparity, ViewIndex view,
                                                  int height, int width);

/// What ways to the strokes must not cross, and where they may pass unseen; all borrowed.
struct StrokeGuides {
  std::vector<ImageView<const float>> colors;  ///< Planes `[y][x]` in which edges count.
  /// `[y][x]`, without holes. Where it is known, its jumps count as well and colours half.
  ImageView<const float> disparity{};
  /// Where labels go on behind what hides them; null = nowhere.
  const LabelSurfaces* surfaces = nullptr;
  /// How far disparity is trusted, `[y][x]` in [0, 1]; empty = everywhere.
  ImageView<const float> trust{};
};

/// How far each pixel of a view is from the strokes of each label.
class StrokeDistances {
 public:
  /// Shortest paths over the 8 neighbours of pixels: a step costs kStep per pixel, the Euclidean
  /// difference of the pixels' colours (half of it beside trusted disparity), and 5 times the trust
  /// for each px of disparity by which they differ more than kSlope_px: slanted surfaces are no
  /// edges. A path may
  /// also begin at any pixel for 1 + the misfit of the label's surface there (label_surfaces.h), as
  /// if it came along the surface behind everything else.
  /// Found by three raster sweeps in both directions: exact where the path turns seldom (Toivanen
  /// 1996; Criminisi et al. 2008, GeoS). Memory: 4 bytes per pixel and label. `strokes` as from
  /// `carried_strokes`. Throws Cancelled.
  StrokeDistances(ImageView<const std::int32_t> strokes, int label_count,
                  const StrokeGuides& guides, const Progress& progress, Isa isa = best_isa());

  static constexpr float kStep = 0.0015F;
  static constexpr float kSlope_px = 0.02F;

  /// By how much the pixel is farther from the strokes of a label than from the nearest ones of
  /// all, at most kMaxExcess; 0 for labels without a stroke in the view.
  [[nodiscard]] float excess(int y, int x, int label) const;
  static constexpr float kMaxExcess = 12;

  /// Multiplies the probabilities of row `y`, `[x][label]`, `pitch()` apart and 0 beyond the
  /// labels, by exp(−strength·excess), and makes them sum to 1 again.
  void weigh_row(int y, double strength, float* probabilities) const;
  /// Labels, rounded up to whole vectors of 16.
  [[nodiscard]] int pitch() const { return pitch_; }

 private:
  void find_ways(const StrokeGuides& guides);
  void add_jumps(const StrokeGuides& guides);
  void begin_on(const LabelSurfaces& surfaces, const Progress& progress);
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
