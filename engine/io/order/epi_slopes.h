// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/light_field/light_field.h"
#include "engine/core/parallel/progress.h"

namespace episcope::io {

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
