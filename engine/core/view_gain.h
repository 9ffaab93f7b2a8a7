// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/light_field.h"
#include "engine/core/progress.h"

#include <cstddef>
#include <vector>

namespace episcope {

/// Gains of views that differ by more than this from 1 are warned of, and evened out for methods.
inline constexpr double kNotableGain = 0.02;

/// Brightness of each view as a multiple of the centre view, by channel and of their sum.
struct ViewGains {
  GridShape grid;
  int channels = 1;
  std::vector<double> channel{};  ///< [v][u][c]; NaN where it could not be measured.
  std::vector<double> overall{};  ///< [v][u]; likewise.

  /// The view whose brightness differs most from the centre view; the centre view if nothing was
  /// measured.
  [[nodiscard]] ViewIndex most_different() const;
  [[nodiscard]] double of(ViewIndex view) const {
    return overall[static_cast<std::size_t>(view.v) * grid.u + view.u];
  }
};

/// Blocks of two views that are compared. One of four takes a quarter of the time and is enough for
/// a report on many views; all are compared if too few of them can be.
enum class GainBlocks { All, OneOfFour };

/// Measures the gains of views against each other.
///
/// The brightness of blocks of a tenth of the image is compared in every two neighbouring views.
/// The median of the ratios of a pair is its gain; the gains of the views fit those of all pairs
/// best (least squares of logarithms). A block is compared at the shift of up to 6 px at which the
/// ratio varies least from pixel to pixel, which does not depend on the gain. Invalid, dark and
/// clipped pixels do not count. Offsets are not measured: parallax would be mistaken for them.
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
