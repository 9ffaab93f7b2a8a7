// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/disparity_field.h"
#include "engine/core/light_field.h"

#include <string>
#include <vector>

namespace episcope::io {

/// How a program may have written maps, if not by rows from top to bottom.
struct MapTurn {
  bool is_transposed = false;
  bool flips_y = false;
  bool flips_x = false;
  const char* text = "";  ///< Such as "rows from bottom to top".
};

/// All of maps of this size: rows and columns are exchanged of square ones only.
[[nodiscard]] std::vector<MapTurn> possible_turns(int height, int width);

/// The maps as they are if they were written so.
[[nodiscard]] DisparityField turned_back(const DisparityField& field, const MapTurn& turn);
/// The same of one map, as a field of one view, (0, 0).
[[nodiscard]] DisparityField turned_back(const DisparityView& map, const MapTurn& turn);

/// What a warning says of `MapTurn::text`, or of what `put_truth_upright` returned.
[[nodiscard]] std::string turned_back_text(const std::string& turn);

/// Truth that was written with its rows from bottom to top (a PFM file by a program that forgets
/// that PFM does so), mirrored, or of square views with rows and columns exchanged (an array by
/// MATLAB), hardly explains the views. Where one of these explains the centre view, or the only
/// one, far better (error after warping below 0.6 of that as stored and of that without warping),
/// puts all maps right and returns what it undid, such as "rows from bottom to top"; empty if it
/// left them as they are.
[[nodiscard]] std::string put_truth_upright(const LightField::Samples& samples,
                                            DisparityField& field);

}  // namespace episcope::io
