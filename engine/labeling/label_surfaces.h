// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/image.h"
#include "engine/core/memory.h"
#include "engine/core/progress.h"

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
  /// `strokes` as from `propagated_strokes` (predict_from_strokes.h), `disparity` of the view,
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

}  // namespace episcope
