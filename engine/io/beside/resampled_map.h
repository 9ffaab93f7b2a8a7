// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/light_field/disparity_field.h"

#include <string>

namespace episcope::io {

/// How maps of another size were brought to that of the views.
struct ResampledMaps {
  double scale = 1;  ///< Pixels of the map in a pixel of the view; 1 = nothing was done.
  std::string note;  ///< Says so; empty if nothing was done.
};

/// Brings maps whose sides are 2 to 8 times those of the views, or as small a part of them, to the
/// size of the views: of the valid values in a pixel the median (of an even number the larger of
/// the two in the middle: means would lie between surfaces), or each value several times. Values
/// stay as they are, also if they count pixels of the map.
[[nodiscard]] ResampledMaps resample_to(DisparityField& field, int height, int width);

}  // namespace episcope::io
