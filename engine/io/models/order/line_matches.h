// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/light_field.h"
#include "engine/core/parallel.h"
#include "engine/core/progress.h"

#include <array>
#include <concepts>
#include <type_traits>
#include <vector>

namespace episcope::io {

/// `look(false)` along u and `look(true)` along v, at the same time where there are threads for it.
/// Reports no progress of its own. Throws what `look` throws.
template <class Look>
requires std::invocable<const Look&, bool>
[[nodiscard]] auto along_both_axes(const Progress& progress, const Look& look) {
  std::array<std::invoke_result_t<const Look&, bool>, 2> found;
  parallel_for(2, progress.part(0, 0),
               [&](int axis) { found[static_cast<std::size_t>(axis)] = look(axis == 1); });
  return found;
}

/// Five views on a line, the middle one and two on either side, as grey levels; of the vertical
/// axis transposed, so that all motion is along x.
struct LineOfViews {
  Image<float> middle;
  std::array<Image<float>, 2> near;  ///< One step before and one after the middle,
  std::array<Image<float>, 2> far;   ///< and `far_step` before and after.
  int far_step = 0;                  ///< 0 = the axis has fewer than three views.
  double near_share = 1;  ///< Distance of the near views as a part of that of the far ones.
};

/// The motion of points of the middle view, in px between it and the far view after it, positive
/// = to the left; NaN where texture is missing or the match is not distinct.
struct LineMatches {
  LineOfViews views;
  Image<float> shift;
};

/// How far points move between neighbouring views along an axis, at most, in px; hardly any move
/// farther. Found in views of at most 128 px, where up to 24 px are looked for; motion of more than
/// `usual_px` counts where views then agree twice as well.
/// 0 if the axis has fewer than three views or the views have no texture. Throws Cancelled.
[[nodiscard]] double largest_motion(const LightField::Samples& samples, bool is_v, double usual_px,
                                    const Progress& progress);

/// Matches windows of 5×5 px against the views before and those after, whichever fit better, so
/// that what is hidden on one side is matched on the other. Shifts are multiples of 0.5 px. Views
/// are reduced to at most `side` px (by whole factors), and their middle of 512×512 px is looked
/// at. Empty if the axis has fewer than three views, the views have no texture, or points move by
/// more than 48 px of the reduced views. Throws Cancelled.
[[nodiscard]] LineMatches match_line(const LightField::Samples& samples, bool is_v, int side,
                                     const Progress& progress);

/// How the slopes of horizontal and vertical EPIs correlate, point by point.
struct SlopeCorrelation {
  double value = 0;  ///< In [−1, 1]; negative: exactly one view axis is reversed.
  int points = 0;    ///< Textured points at which both slopes were found,
  int squares = 0;   ///< and squares of 8×8 px that have any: windows of points nearer to each
                     ///< other overlap.

  /// Whether so many squares do not correlate so by chance.
  [[nodiscard]] bool is_decided() const;
};

/// Matches small windows of the view at the centre of the grid against its neighbours along u and
/// along v and correlates the two disparities. Where the scene has hardly any depth the correlation
/// about zero takes the place of the one about the means. Linear in the image area and in the
/// search range: a 48th of the width, or as far as points move, but not beyond 64 px; at most
/// 512×512 px in the middle of the view are looked at. Throws Cancelled.
[[nodiscard]] SlopeCorrelation correlate_epi_slopes(const LightField::Samples& samples,
                                                    const Progress& progress);

}  // namespace episcope::io
