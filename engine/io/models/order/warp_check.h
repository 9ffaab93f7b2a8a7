// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/disparity_field.h"
#include "engine/core/image.h"
#include "engine/core/indices.h"
#include "engine/core/light_field.h"

#include <optional>
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
  double left = 1;   ///< What the map leaves of the error of that disparity there.

  /// Whether the map can be told from a constant.
  [[nodiscard]] bool is_told() const;
  /// Whether the map is told from a constant, and better by more than chance or by half the error.
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

/// Another meaning of the numbers of a map: times `factor`, plus `offset_px`, px per view step.
struct BetterUnit {
  double factor = 1;
  double offset_px = 0;
  double error = 0;           ///< Mean grey error (0 … 255) of the next views, warped so,
  double error_as_taken = 0;  ///< and as the map is taken: 40 if out of the views.
};

/// Looks for a meaning that explains the neighbors of `at` clearly better than the map times
/// `factor`, and than no warping: first another factor, up to 64 times as large or small, then also
/// an offset, as normalized values lack. Clearly: less error by 15 % (20 % with an offset), and by
/// more than chance over squares of 16×16 px. Each axis counts in its better order, brightness as
/// it is. Samples about 10,000 pixels.
[[nodiscard]] std::optional<BetterUnit> find_better_unit(const LightField::Samples& samples,
                                                         ViewIndex at, const DisparityView& map,
                                                         double factor);

}  // namespace episcope::io
