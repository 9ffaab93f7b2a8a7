// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/array/indices.h"
#include "engine/core/light_field/camera_grid.h"
#include "engine/core/light_field/scene.h"
#include "engine/io/open/open_options.h"

#include <functional>
#include <string>
#include <vector>

namespace episcope::io {

/// What is known about the depth before its units are settled.
struct DepthFacts {
  CameraGrid stored;  ///< dH, focalLength, shift, camDistance as the file has them.
  int width = 0;      ///< xRes.
  Interval depth;     ///< Range of the valid depth of the reference view.
};

struct UnitsFinding {
  CameraGrid camera;  ///< Gives px per view step.
  std::string text;   ///< As ConventionReport::units,
  std::string check;  ///< and `units_check`.
  std::vector<std::string> warnings;
};

/// Determines whether dH and shift include the factor xRes: of the readings that give |d| < 20 px
/// and, if any does, a depth of zero disparity inside the depth range, the one that warps the views
/// onto each other best. `warp_error(camera)` is in grey levels.
[[nodiscard]] UnitsFinding find_units(const DepthFacts& facts, Units choice,
                                      const std::function<double(const CameraGrid&)>& warp_error);

/// Where camDistance contradicts dH·focalLength/shift, the latter becomes the depth of zero
/// disparity, since disparity is computed by it, and a warning says so.
void settle_zero_depth(CameraGrid& camera, ConventionReport& report);

}  // namespace episcope::io
