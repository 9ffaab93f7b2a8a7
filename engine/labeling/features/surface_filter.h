// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/array/image.h"
#include "engine/core/parallel/isa.h"
#include "engine/core/parallel/progress.h"

#include <array>

namespace episcope {

/// Three channels of colour, `[y][x]` each.
using ColorPlanes = std::array<Image<float>, 3>;

struct SurfaceFilter {
  double contrast = 0.1;  ///< σ of the difference of colours, summed over the channels; > 0.
  double scale_px = 6;    ///< σ of the distance; > 0.
  int radius_px = 6;      ///< Neighbours that are farther do not count.
  Isa isa = best_isa();   ///< Other than that for tests.
};

/// Colours averaged within a surface and not across its outline: the bilateral filter of Tomasi and
/// Manduchi 1998 with the sum of absolute differences, as cv::bilateralFilter, to about 10⁻⁶, and a
/// third of its time. Pixels beyond the border are those at the border. Throws Cancelled.
[[nodiscard]] ColorPlanes filter_surfaces(const ColorPlanes& colors, const SurfaceFilter& filter,
                                          const Progress& progress);

}  // namespace episcope
