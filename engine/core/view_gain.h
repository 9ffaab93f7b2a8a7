// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/light_field.h"
#include "engine/core/progress.h"

#include <cstddef>
#include <vector>

namespace episcope {

/// Gains of views that differ by more than this from 1 are warned of, and evened out for methods.
inline constexpr double kNotableGain = 0.02;

/// How bright each view is, as a multiple of the centre view: of each channel, and of their sum.
struct ViewGains {
  GridShape grid;
  int channels = 1;
  std::vector<double> channel{};  ///< [v][u][c]; NaN where it could not be measured.
  std::vector<double> overall{};  ///< [v][u]; likewise.

  /// The view whose brightness differs most from that of the centre view, which itself is given if
  /// nothing was measured.
  [[nodiscard]] ViewIndex most_different() const;
  [[nodiscard]] double of(ViewIndex view) const {
    return overall[static_cast<std::size_t>(view.v) * grid.u + view.u];
  }
};

/// Which blocks of two views are compared: all, or one of four, which takes a quarter of the time
/// and is enough for a report on many views; all of them where too few of those can be compared.
enum class GainBlocks { All, OneOfFour };

/// Measures the gains of views against each other: the median, over blocks of a tenth of the image,
/// of the ratio of the brightness of a block in two neighbouring views, and the gains that fit all
/// these ratios best (least squares of their logarithms). A block is compared where the other view
/// shows it, within 6 px: where the ratio varies least from pixel to pixel, which does not depend
/// on the gain. Invalid, dark or clipped pixels do not count.
/// A gain is all that is measured: an offset would be confused with what parallax changes.
/// `valid`: as LightField::valid. 36 pixels of each block are looked at. Throws Cancelled.
[[nodiscard]] ViewGains measure_view_gains(const LightField::Samples& samples,
                                           const ViewStack<std::uint8_t>& valid,
                                           const Progress& progress,
                                           GainBlocks blocks = GainBlocks::All);

/// Divides the samples of each view by its gains, channel by channel, in their stored type; views
/// without a gain stay. Returns the share in [0, 1] of samples that were clipped at the largest
/// number of their type. Throws Cancelled.
double divide_by_gains(LightField::Samples& samples, const ViewGains& gains,
                       const Progress& progress);

}  // namespace episcope
