// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/light_field.h"
#include "engine/core/progress.h"

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <string>
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

/// Blocks of two views that are compared. One of four takes a quarter of the time and is enough for
/// a report on many views; all are compared if too few of them can be.
enum class GainBlocks { All, OneOfFour };

/// Measures the gains of views against each other.
///
/// The brightness of blocks of a tenth of the image is compared in every two neighboring views.
/// The median of the ratios of a pair is its gain; the gains of the views fit the gains of all
/// pairs best (least squares of logarithms). A block is compared at the shift of up to 6 px at
/// which the ratio varies least from pixel to pixel, which does not depend on the gain. Invalid,
/// dark and clipped pixels do not count. Offsets are not measured: parallax would be mistaken for
/// them. `valid`: as LightField::valid. 36 pixels of each block are looked at. Throws Cancelled.
[[nodiscard]] PhotometricCorrection measure_view_gains(const LightField::Samples& samples,
                                                       const ViewStack<std::uint8_t>& valid,
                                                       const Progress& progress,
                                                       GainBlocks blocks = GainBlocks::All);

/// A quick look, at one of 64 pixels: whether the mean of a view differs by more than 1 % from the
/// mean of the center view. Views whose means are alike have gains that are, too. Throws Cancelled.
[[nodiscard]] bool have_notable_means(const LightField& light_field, const Progress& progress);

/// Gains by the means of whole views alone, before anything is known of their disparity. Objects
/// that come into a view change its mean as well, but steadily from view to view: where means are
/// off the mean of their neighbors' in a row by no more than 0.5 % gains would explain, all gains
/// are 1. Throws Cancelled.
[[nodiscard]] PhotometricCorrection gains_of_means(const LightField& light_field,
                                                   ViewIndex reference, const Progress& progress);

/// A reading option: differences of brightness between views are left to the method.
inline constexpr const char* kKeepBrightness = "no-equalize";

/// A light field whose views have equal brightness, and how much they differed.
struct EvenLightField {
  LightField light_field;
  std::string note;  ///< For an estimate.
};

/// Equalizes the views of a light field on first use and keeps the result. Most methods compare
/// views or follow lines through them, and take a gain for structure. Thread-safe.
class EvenViews {
 public:
  /// A copy of the light field without the gains of its views (measure_view_gains). Null if no
  /// gain is notable, or if it was read with kKeepBrightness. Other callers wait; if it throws,
  /// nothing is kept. Measuring reads light fields on disk as a whole; the copy goes to disk if it
  /// does not fit into memory. Another light field replaces what is kept. Throws Cancelled, IoError
  /// if there is no room on the disk.
  [[nodiscard]] std::shared_ptr<const EvenLightField> of(const LightField& light_field,
                                                         const Progress& progress);
  /// Bytes of memory of the copy that is kept.
  [[nodiscard]] std::size_t bytes() const { return bytes_; }

 private:
  std::mutex lock_;
  std::uint64_t measured_ = 0;  // LightField::identity; 0 = none
  std::shared_ptr<const EvenLightField> even_;
  std::atomic<std::size_t> bytes_{0};
};

}  // namespace episcope
