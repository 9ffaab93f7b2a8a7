// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/disparity_field.h"

#include <string>

namespace episcope::io {

/// Crops maps that networks have padded to the size of the views. The padding must be evident:
/// equal on all sides, or right and below, and in every map of one value or invalid. Returns a
/// sentence about what was cut off; empty if the maps fit already or the padding is not evident.
[[nodiscard]] std::string remove_padding(DisparityField& field, int height, int width);

/// A border of the views for which maps have no values.
struct BareBorder {
  int width_px = 0;  ///< On each side; 0 = the maps fill the views, or do not fit.
  std::string note;  ///< Says so; empty if the maps fill the views.
};

/// Finds the part of the views that maps cover, if it is evident, and makes the pixels around it
/// invalid:
/// - maps that lack the same even number of rows and columns, as convolutions without padding leave
///   them (490×490 px for 512×512), are put into the middle;
/// - in maps of the size of the views, a frame of one value in every map, at least two pixels wide,
///   is taken for padding if at most a tenth of the ring within has that value. The border is at
///   most an eighth of the shorter side wide.
[[nodiscard]] BareBorder find_bare_border(DisparityField& field, int height, int width);

}  // namespace episcope::io
