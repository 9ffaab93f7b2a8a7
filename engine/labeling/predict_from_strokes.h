// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/disparity_field.h"
#include "engine/core/image.h"
#include "engine/core/isa.h"
#include "engine/core/progress.h"
#include "engine/core/scene.h"
#include "engine/labeling/forest.h"
#include "engine/labeling/label_surfaces.h"
#include "engine/labeling/ray_labeling.h"

#include <cstdint>
#include <vector>

namespace episcope {

/// Propagates the strokes of all painted views to one view, `[y][x]`: an index of `ids` (ascending)
/// plus one, 0 = none. Strokes follow the rays of `disparity` to pixels that are visible in the
/// view (ray_labeling.h). Views without disparity are skipped.
[[nodiscard]] Image<std::int32_t> propagated_strokes(const Scribbles& scribbles,
                                                     const std::vector<std::int32_t>& ids,
                                                     const DisparityField* disparity,
                                                     ViewIndex view, int height, int width);

/// Edges that paths to the strokes should not cross, and surfaces that may pass behind others;
/// everything is borrowed.
struct StrokeGuides {
  std::vector<ImageView<const float>> colors;  ///< Planes `[y][x]` in which edges count.
  /// `[y][x]`, without holes. With it, its jumps count too, and edges of color count half.
  ImageView<const float> disparity{};
  /// Surfaces of labels, which continue behind occluders; null = none.
  const LabelSurfaces* surfaces = nullptr;
  /// How far disparity is trusted, `[y][x]` in [0, 1]; empty = everywhere.
  ImageView<const float> trust{};
};

/// How far each pixel of a view is from the strokes of each label.
class StrokeDistances {
 public:
  /// Computes shortest paths over the 8 neighbors of pixels. A step costs kStep per pixel, plus the
  /// Euclidean difference of colors (half beside trusted disparity), plus 5·trust for each px by
  /// which disparities differ more than kSlope_px, so that slanted surfaces are no edges. A path
  /// may also begin at any pixel for 1 + the misfit of the label's surface there
  /// (label_surfaces.h), as if it came along that surface behind everything else.
  ///
  /// Three raster sweeps in both directions, exact where paths turn seldom (Toivanen 1996;
  /// Criminisi et al. 2008, GeoS). 4 bytes per pixel and label. `strokes` as from
  /// `propagated_strokes`. Throws Cancelled.
  StrokeDistances(ImageView<const std::int32_t> strokes, int label_count,
                  const StrokeGuides& guides, const Progress& progress, Isa isa = best_isa());

  static constexpr float kStep = 0.0015F;
  static constexpr float kSlope_px = 0.02F;

  /// Distance of the pixel to the strokes of a label minus its distance to the nearest strokes of
  /// any, at most kMaxExcess; 0 for labels without a stroke in the view.
  [[nodiscard]] float excess(int y, int x, int label) const;
  static constexpr float kMaxExcess = 12;

  /// Multiplies the probabilities of row `y`, `[x][label]`, `pitch()` apart and 0 beyond the
  /// labels, by exp(−strength·excess), and normalizes the sum of each pixel to 1.
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

/// Strokes, and evidence for where their labels continue; borrowed.
struct StrokeKnowledge {
  const Scribbles& scribbles;
  const std::vector<std::int32_t>& ids;          ///< Of the labels painted, ascending.
  double nearness = 0;                           ///< LabelerParameters::nearness.
  const DisparityField* disparity = nullptr;     ///< Null = strokes stay in their views.
  const ViewStack<float>* confidence = nullptr;  ///< Of the disparity; null = it is right.
  bool judges_disparity = false;  ///< Whether disparity is evidence for labels; needs `disparity`.
};

/// Weights the forest's votes for the pixels of a view: by how well their disparity fits the
/// surface of each label, and by how near its strokes are (labeler.h says why). `features` of the
/// view. Throws Cancelled.
[[nodiscard]] ProbabilityMap predict_from_strokes(const StrokeKnowledge& known, ViewIndex view,
                                                  VolumeView<const float> features,
                                                  const PixelVotes& votes,
                                                  const Progress& progress);

/// How far the surface of each label holds away from its strokes, `[label]` in (0, 1]. Where the
/// forest gives a label at least kSureShare of its votes, disparity is not needed. If it fits other
/// labels better there, the estimate is wrong or the label is no plane, so its misfits should count
/// less. The support is the mean of exp(−(misfit − least misfit of all labels)) over those pixels,
/// weighted by trust, plus kPrior pixels that fit, so that labels without such pixels are believed.
///
/// Uses every eighth row. `trust` of the disparity `[y][x]` in [0, 1], empty = 1. An addition to
/// [WSG13]; tests/accuracy/tuning.md has the gain. Throws Cancelled.
[[nodiscard]] std::vector<float> surface_support(const PixelVotes& votes,
                                                 const LabelSurfaces& surfaces,
                                                 ImageView<const float> trust,
                                                 const Progress& progress);

}  // namespace episcope
