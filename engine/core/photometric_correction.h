// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/light_field.h"
#include "engine/core/progress.h"

#include <array>
#include <cstddef>
#include <vector>

namespace episcope {

/// How the brightness of views differs from the brightness of a reference view: gains, and the
/// fall-off to the corners that all views share. Measured by measure_view_gains and gains_of_means
/// (view_gain.h) and by correction_of_points (engine/disparity).
struct PhotometricCorrection {
  GridShape grid{};
  /// [v][u][c], multiples of the reference; grey: three equal ones. NaN where it could not be
  /// measured; empty = all 1.
  std::vector<std::array<double, 3>> gains{};
  /// [v][u], of the sum of the channels, likewise; of measure_view_gains only.
  std::vector<double> overall{};
  /// k of the fall-off 1 − k·r², r² = 1 in the corners (CornerRadius).
  double fall_off = 0;

  /// The view whose brightness differs most from the center view; the center view if nothing was
  /// measured. Precondition of this and the next two: `overall` is there.
  [[nodiscard]] ViewIndex most_different() const;
  [[nodiscard]] double of(ViewIndex view) const {
    return overall[static_cast<std::size_t>(view.v) * grid.u + view.u];
  }
  /// Whether the overall gain of a view differs by more than 2 % from 1: worth a warning, and a
  /// correction for methods.
  [[nodiscard]] bool is_notable() const;
  /// The largest |gain − 1| of any channel that was measured.
  [[nodiscard]] double largest_difference() const;
  /// Whether it is worth a correction once disparities are known: root mean square of log gains
  /// above 0.5 %, or |fall_off| > 0.1. Precondition: no gain is NaN.
  [[nodiscard]] bool is_uneven() const;
};

/// r² of a pixel: 0 in the middle of the image, 1 in its corners.
class CornerRadius {
 public:
  CornerRadius(int height, int width);
  [[nodiscard]] double squared(double y, double x) const {
    return ((y - y_) * (y - y_) + (x - x_) * (x - x_)) / corner_;
  }

 private:
  double y_, x_, corner_;
};

/// Divides the samples of each view by its gains, channel by channel, in their stored type; views
/// without a gain stay. Returns the share in [0, 1] of samples that were clipped at the largest
/// number of their type. Preconditions: gains of all views, no fall-off. Throws Cancelled.
double divide_by_gains(LightField::Samples& samples, const PhotometricCorrection& correction,
                       const Progress& progress);

/// The light field without gains and fall-off, in 16 bits, at most 1. Throws Cancelled.
[[nodiscard]] LightField corrected(const LightField& light_field,
                                   const PhotometricCorrection& correction,
                                   const Progress& progress);

}  // namespace episcope
