// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/array/image.h"

namespace episcope::io {

/// The period with which the brightness of a picture changes along its lines. From one lenslet to
/// the next, the view jumps from the last to the first, and so does the brightness; lenslets with
/// dark borders show their period in the brightness itself.
struct LensletPeriod {
  int period_px = 0;     ///< 0 = none was found.
  double explained = 0;  ///< Part of the variance of differences of neighbours that repeats,
  double jump = 0;       ///< their largest over their median within a period,
  double shading = 0;    ///< and part of the variance of the brightness itself that repeats.

  /// Whether the lines are those of lenslets: half of the variance repeats, with a jump of 1.5. Of
  /// multiples of 4 the brightness must repeat as well, because pictures that were compressed as
  /// JPEG have jumps every 8 or 16 px.
  [[nodiscard]] bool is_certain() const;
  /// The same without regard to compression: for a picture of which one knows otherwise that it
  /// consists of lenslets.
  [[nodiscard]] bool is_likely() const;
  /// For such a picture that is a JPEG: of multiples of 8 the brightness must repeat.
  [[nodiscard]] bool is_likely_in_jpeg() const;
};

/// `lines`: brightness, a line a row. Periods of 3 to 32 px are tried.
[[nodiscard]] LensletPeriod find_lenslet_period(const Image<float>& lines);

}  // namespace episcope::io
