// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/disparity_field.h"
#include "engine/core/image.h"
#include "engine/core/indices.h"
#include "engine/core/light_field.h"

#include <array>
#include <vector>

namespace episcope::io {

/// Mean absolute differences in grey levels (0 … 255) between a view and its neighbors along one
/// view axis, warped onto it by a disparity map.
struct AxisErrors {
  double forward = 0;    ///< If the axis has the canonical direction,
  double reversed = 0;   ///< and if it runs the other way.
  double unwarped = 0;   ///< Without warping: as if all disparities were 0.
  long long pixels = 0;  ///< Compared; 0 if the axis has one view only.

  /// Whether the two differ by more than noise does: 3 % and 0.02 grey levels.
  [[nodiscard]] bool is_decided() const;
  /// Whether warping hardly explains the views: it improves on the other order or on no warping by
  /// less than 10 %, or is worse than no warping while the order is undecided.
  [[nodiscard]] bool is_poor() const;
  [[nodiscard]] bool says_reversed() const { return reversed < forward; }
};

struct WarpErrors {
  AxisErrors u;
  AxisErrors v;

  /// Mean error of the better order of each axis.
  [[nodiscard]] double best() const;
  /// Mean error without warping.
  [[nodiscard]] double unwarped() const;
};

/// Converts a view to grey levels in 0 … 255. 16-bit samples are scaled by the number of bits in
/// use. A sample that is not finite takes the value to its left.
[[nodiscard]] Image<float> grey_levels(const LightField::Samples& samples, ViewIndex view);
/// Converts a part of the view, which must lie within it.
[[nodiscard]] Image<float> grey_levels(const LightField::Samples& samples, ViewIndex view,
                                       const PixelRect& part);

/// Warps up to four neighbors of `at` onto it. Only pixels count that have a valid disparity and
/// targets inside the image for both orders, so that both are judged by the same pixels. Brightness
/// that differs by more than 2 % is evened out.
[[nodiscard]] WarpErrors warp_errors(const LightField::Samples& samples, ViewIndex at,
                                     const DisparityView& disparity);

/// A pixel of a map that has a value.
struct MapPoint {
  int y = 0;
  int x = 0;
  double disparity = 0;
};

/// About 10,000 of them, in equal steps over the map.
[[nodiscard]] std::vector<MapPoint> spread_points(const DisparityView& map);

/// How much better a map explains the neighbors of its view than a constant disparity does.
struct ConstantComparison {
  int squares = 0;   ///< Of 16×16 px in which the map differs from that disparity.
  double score = 0;  ///< By how many standard deviations of chance the map is better there.

  /// Whether the map can be told from a constant.
  [[nodiscard]] bool is_told() const;
  /// Whether the map is told from a constant and better by more than chance.
  [[nodiscard]] bool is_better() const;
};

/// Warps up to four neighbors of `at`, evened out in brightness: with the map, in the order of each
/// axis that `errors` says, and with the constant disparity that explains that axis best. The
/// constant lies within the range of the map on either side of 0. A wrong map of the right mean may
/// explain views better than no warping, but hardly better than the constant. Samples about 10,000
/// pixels.
[[nodiscard]] ConstantComparison compare_with_constant(const LightField::Samples& samples,
                                                       ViewIndex at, const DisparityView& disparity,
                                                       const WarpErrors& errors);

/// Mean grey errors of the same neighbors by a map times each factor, each axis in its better
/// order; infinite where the map leads most pixels out of the views. Brightness is as it is.
[[nodiscard]] std::vector<double> errors_of_factors(const LightField::Samples& samples,
                                                    ViewIndex at, const DisparityView& map,
                                                    const std::vector<double>& factors);

/// Pictures of one channel for looking at the motion between views, `[y][x]`.

/// Cuts out the middle of a picture, at most `side` by `side` px.
[[nodiscard]] Image<float> middle_of(const Image<float>& picture, int side);

/// Averages squares of k by k px, with the smallest whole k that brings the larger side to at most
/// `side` px.
[[nodiscard]] Image<float> reduced(const Image<float>& picture, int side);

/// Smallest whole k that brings a side to at most `side` px.
[[nodiscard]] int reduction(int larger, int side);
/// Averages squares of k by k px.
[[nodiscard]] Image<float> reduced_by(const Image<float>& picture, int k);

/// Applies a Gaussian blur of 0.7 px, against noise and aliasing. The border is repeated.
[[nodiscard]] Image<float> smoothed(const Image<float>& picture);

/// Subtracts Gaussian blurs of 0.8 and 4 px and normalizes to mean 0 and variance 1. This removes
/// brightness, contrast and slow changes. All 0 for a picture without texture.
[[nodiscard]] Image<float> band_passed(const Image<float>& picture);

/// Grey view prepared for finding motion between views: band-passed, from fine to coarse. Scales:
/// the middle of 256×256 px, the whole reduced to 160 px, and the whole reduced to 40 px.
struct MotionPictures {
  static constexpr int kScales = 3;

  explicit MotionPictures(const Image<float>& grey);
  MotionPictures() = default;

  std::array<Image<float>, kScales> scales;
  double contrast = 0;  ///< Standard deviation of the reduced view, in its grey levels.
};

/// Correlation of two pictures of one scale, at the same places: 1 for equal pictures.
[[nodiscard]] double correlation(const Image<float>& a, const Image<float>& b);

}  // namespace episcope::io
