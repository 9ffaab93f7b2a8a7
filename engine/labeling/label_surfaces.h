// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/image.h"
#include "engine/core/memory.h"
#include "engine/core/progress.h"

#include <array>
#include <cstdint>
#include <vector>

namespace episcope {

/// Where the surface of each label is expected in a view: a plane through the disparities of its
/// strokes, and how far it can be trusted away from them. Says how well the disparity of a pixel
/// fits each label wherever the pixel lies, so that ground keeps its label at depths that nobody
/// painted and a wall goes on behind a fence.
///
/// A plane in space is one in (x, y, d). Each is fitted by least squares with Cauchy weights of
/// three robust standard deviations, its slopes drawn to 0 where the strokes are short. The
/// variance of the disparity at a pixel is that of the strokes about their plane, with
/// kNoise_px² added, and grows with the leverage h = (1, x, y) M⁻¹ (1, x, y)ᵀ of the pixel, M the
/// mean of (1, x, y)ᵀ(1, x, y) over the strokes, and with the spread of disparities within 2 px,
/// because estimates are vague beside jumps. An own addition to [WSG13]; what it gains is in
/// tests/accuracy/tuning.md.
class LabelSurfaces {
 public:
  /// `strokes` as from `carried_strokes` (stroke_distance.h), `disparity` of the view, without
  /// holes, and how far it is trusted (`disparity_trust`; empty = everywhere), borrowed. 4·pitch
  /// bytes per pixel. Throws Cancelled.
  LabelSurfaces(ImageView<const std::int32_t> strokes, int label_count,
                ImageView<const float> disparity, ImageView<const float> trust,
                const Progress& progress);

  /// Standard deviation below which disparities say nothing, px per view step.
  static constexpr double kNoise_px = 0.04;
  /// Most that a single pixel's disparity can speak against a label.
  static constexpr float kMostMisfit = 3;

  /// How far the surface of each label holds away from its strokes, `[label]` in [0, 1]
  /// (engine/labeling/predict_from_strokes.h): from now on misfits exceed the least one of their pixel
  /// by this share only. Before, all hold. Throws Cancelled.
  void set_support(const std::vector<float>& support, const Progress& progress);

  /// Labels that show in gaps of what lies before them (engine/labeling/predict_from_strokes.h), `[y][x]`, an
  /// index plus one, 0 = none: from now on disparity does not speak against them there.
  void set_gaps(ImageView<const std::int32_t> labels);

  /// Whether the surface of a label is known and lies behind the disparity of a pixel.
  [[nodiscard]] bool lies_behind(int label, int y, int x) const;

  /// −log of how probable the disparity of each pixel of row `y` is on the surface of each label,
  /// at most kMostMisfit: log(1 + r²/σ²) + log(σ/kNoise_px), r the distance from its plane.
  /// kMostMisfit/2 for labels of too few stroke pixels. `[x][label]`, `pitch()` apart.
  [[nodiscard]] const float* misfits(int y) const { return misfits_.get() + y * row_size(); }
  [[nodiscard]] int pitch() const { return pitch_; }

  /// Multiplies the probabilities of row `y`, `[x][label]`, `pitch()` apart and 0 beyond the
  /// labels, by exp(−1.5·trust·misfit), and makes them sum to 1 again. Before, 0.02 is added to
  /// each: a forest is never that sure.
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
  Image<float> doubt_;  // Variance of disparities beside jumps, px².
  std::vector<Surface> surfaces_;
  int pitch_;
  LargeArray<float> misfits_;  // [y][x][label], pitch_ apart.
};

}  // namespace episcope
