// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/light_field.h"
#include "engine/core/parallel.h"
#include "engine/core/progress.h"

#include <array>
#include <concepts>
#include <memory>
#include <type_traits>

namespace episcope::io {

/// Calls `look(false)` for u and `look(true)` for v, in parallel where threads are free. Reports no
/// progress of its own. Throws what `look` throws.
template <class Look>
requires std::invocable<const Look&, bool>
[[nodiscard]] auto along_both_axes(const Progress& progress, const Look& look) {
  std::array<std::invoke_result_t<const Look&, bool>, 2> found;
  parallel_for(2, progress.part(0, 0),
               [&](int axis) { found[static_cast<std::size_t>(axis)] = look(axis == 1); });
  return found;
}

/// Grey levels of five views on a line: the middle one and two on either side. Views of the
/// vertical axis are transposed, so that all motion is along x.
struct LineOfViews {
  Image<float> middle;
  std::array<Image<float>, 2> near;  ///< One step before and one after the middle,
  std::array<Image<float>, 2> far;   ///< and `far_step` before and after.
  int far_step = 0;                  ///< 0 = the axis has fewer than three views.
  double near_share = 1;             ///< Distance of the near views as a share of the far ones'.
};

/// Motion of points of the middle view to the far view after it, in px, positive = to the left. NaN
/// where texture is missing or the match is not distinct.
struct LineMatches {
  LineOfViews views;
  Image<float> shift;
};

/// Motion between neighboring views in pictures of at most 128 px, where up to 24 px are searched:
/// once for each axis, whatever asks. Both axes may be asked at a time, each by one thread.
class CoarseMotion {
 public:
  /// Keeps a reference to `samples`.
  CoarseMotion(const LightField::Samples& samples);
  ~CoarseMotion();

  [[nodiscard]] const LightField::Samples& samples() const { return samples_; }
  /// Largest motion of points between neighboring views along an axis, in px; a few may move
  /// farther. Motion above `usual_px` counts only if views then agree twice as well. 0 if the axis
  /// has fewer than three views or the views have no texture. Throws Cancelled.
  [[nodiscard]] double largest(bool is_v, double usual_px, const Progress& progress) const;

 private:
  struct Search;
  const LightField::Samples& samples_;
  mutable std::array<std::unique_ptr<const Search>, 2> along_;  ///< u and v, once searched.
};

/// Matches windows of 5×5 px with the views before and the views after, and keeps the better side:
/// points hidden on one side are matched on the other. Shifts are multiples of 0.5 px. Views are
/// reduced to at most `side` px (by whole factors); only their middle of 512×512 px is matched.
/// Empty if the axis has fewer than three views, the views have no texture, or points move by more
/// than 48 px of the reduced views. Throws Cancelled.
[[nodiscard]] LineMatches match_line(const CoarseMotion& coarse, bool is_v, int side,
                                     const Progress& progress);

/// Correlation of the slopes of horizontal and vertical EPIs, point by point.
struct SlopeCorrelation {
  double value = 0;  ///< In [−1, 1]; negative: exactly one view axis is reversed.
  int points = 0;    ///< Textured points at which both slopes were found,
  int squares = 0;   ///< and squares of 8×8 px that have any: windows of points nearer to each
                     ///< other overlap.

  /// Whether chance would hardly make so many squares correlate.
  [[nodiscard]] bool is_decided() const;
};

/// Matches small windows of the center view with its neighbors along u and along v and correlates
/// the two disparities: about zero if the scene has hardly any depth, else about their means. Uses
/// at most 512×512 px in the middle of the view. Searches a 48th of the smaller side, or the
/// distance that points move, at most 64 px. Linear in the image area and in the search range.
/// Throws Cancelled.
[[nodiscard]] SlopeCorrelation correlate_epi_slopes(const CoarseMotion& coarse,
                                                    const Progress& progress);

}  // namespace episcope::io
