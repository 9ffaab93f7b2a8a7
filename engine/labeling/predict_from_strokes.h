// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/disparity_field.h"
#include "engine/core/image.h"
#include "engine/core/isa.h"
#include "engine/core/memory.h"
#include "engine/core/progress.h"
#include "engine/core/scene.h"
#include "engine/labeling/forest.h"
#include "engine/labeling/ray_labeling.h"

#include <array>
#include <cstdint>
#include <vector>

namespace episcope {

/// Fits a plane in (x, y, d) to the disparities of each label's strokes, and measures how well the
/// disparity of any pixel fits each label. Ground thus keeps its label at depths that nobody
/// painted, and a wall continues behind a fence.
///
/// Planes are fitted by least squares with Cauchy weights of three robust standard deviations;
/// short strokes draw the slopes to 0. The variance at a pixel is the variance of the strokes about
/// their plane plus kNoise_px². It grows with the leverage h = (1, x, y) M⁻¹ (1, x, y)ᵀ, where M is
/// the mean of (1, x, y)ᵀ(1, x, y) over the strokes. An addition to [WSG13];
/// tests/accuracy/tuning.md has the gain.
class LabelSurfaces {
 public:
  /// `strokes` as from `propagated_strokes`, `disparity` of the view,
  /// without holes, and how far it is trusted (`disparity_trust`; empty = everywhere), borrowed.
  /// 4·pitch bytes per pixel. Throws Cancelled.
  LabelSurfaces(ImageView<const std::int32_t> strokes, int label_count,
                ImageView<const float> disparity, ImageView<const float> trust,
                const Progress& progress);

  /// Standard deviation below which disparities say nothing, px per view step.
  static constexpr double kNoise_px = 0.04;
  /// Largest misfit of a label at one pixel.
  static constexpr float kMostMisfit = 3;

  /// Sets how far the surface of each label holds away from its strokes, `[label]` in [0, 1]
  /// (`surface_support`). A misfit then exceeds the least misfit of its pixel by this share only;
  /// at first the share is 1. Throws Cancelled.
  void set_support(const std::vector<float>& support, const Progress& progress);

  /// Negative log-likelihoods of row `y`, at most kMostMisfit: log(1 + r²/σ²) + log(σ/kNoise_px), r
  /// the distance of the disparity from the label's plane. kMostMisfit/2 for labels of too few
  /// stroke pixels. `[x][label]`, `pitch()` apart.
  [[nodiscard]] const float* misfits(int y) const { return misfits_.get() + y * row_size(); }
  [[nodiscard]] int pitch() const { return pitch_; }

  /// Adds 0.02 to each probability of row `y`, multiplies it by exp(−1.5·trust·misfit) and
  /// normalizes the sum of each pixel to 1. `[x][label]`, `pitch()` apart and 0 beyond the labels.
  void weigh_row(int y, float* probabilities) const;

 private:
  struct Surface {
    bool is_known = false;
    double x = 0, y = 0;              // Middle of the strokes, from which x and y are measured.
    std::array<double, 3> plane{};    // d = plane·(1, x, y)
    std::array<double, 6> inverse{};  // M⁻¹: 00, 01, 02, 11, 12, 22.
    double variance = 0;              // Of the strokes about the plane.
  };
  struct Sample {
    double x, y, d;
  };
  static Surface fit(const std::vector<Sample>& samples, double ridge_px2);
  static void solve(const std::vector<Sample>& samples, const std::vector<double>& weights,
                    double ridge_px2, Surface& surface);
  void find_misfits(int y);
  [[nodiscard]] std::ptrdiff_t row_size() const {
    return static_cast<std::ptrdiff_t>(disparity_.width) * pitch_;
  }

  ImageView<const float> disparity_;
  ImageView<const float> trust_;
  std::vector<Surface> surfaces_;
  int pitch_;
  LargeArray<float> misfits_;  // [y][x][label], pitch_ apart.
};

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
  /// (LabelSurfaces), as if it came along that surface behind everything else.
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
