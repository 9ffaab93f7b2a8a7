// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/disparity_field.h"
#include "engine/core/light_field.h"
#include "engine/io/models/order/warp_check.h"

#include <optional>
#include <string>
#include <vector>

namespace episcope::io {

/// Order of pixels in which a program may have written maps, other than by rows from top to bottom.
struct MapTurn {
  bool is_transposed = false;
  bool flips_y = false;
  bool flips_x = false;
  const char* text = "";  ///< Such as "rows from bottom to top".
};

/// All turns of maps of this size. Rows and columns are exchanged in square maps only.
[[nodiscard]] std::vector<MapTurn> possible_turns(int height, int width);

/// Undoes the turn in all maps.
[[nodiscard]] DisparityField turned_back(const DisparityField& field, const MapTurn& turn);
/// Undoes the turn of one map; returns a field of the single view (0, 0).
[[nodiscard]] DisparityField turned_back(const DisparityView& map, const MapTurn& turn);

/// Warning about `MapTurn::text` or `UprightTruth::undone`.
[[nodiscard]] std::string turned_back_text(const std::string& turn);

/// Truth in the usual order of pixels.
struct UprightTruth {
  std::string undone;  ///< Such as "rows from bottom to top"; empty = the truth was upright.
  std::optional<WarpErrors> errors{};  ///< Of warping by the map of one view; none without truth.
};

/// Corrects truth with rows from bottom to top (PFM of a program that forgets its order), mirrored
/// truth, and square truth with rows and columns exchanged (an array by MATLAB). Such truth hardly
/// explains the views. A turn is undone in all maps if it explains the center view, or the only
/// one, far better: its error after warping is below 0.6 of the error as stored and of the error
/// without warping.
[[nodiscard]] UprightTruth put_truth_upright(const LightField::Samples& samples,
                                             DisparityField& field);

}  // namespace episcope::io
