// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/indices.h"
#include "engine/core/light_field.h"

#include <vector>

namespace episcope {

/// Position of a view on the plane of cameras, in mean steps of the grid, along v and u.
struct ViewPlace {
  double v = 0;
  double u = 0;
};

/// Relation of the stated positions of cameras to a grid.
enum class PlacesKind {
  Unknown,      ///< There are none.
  Regular,      ///< Equidistant to within 0.02 steps.
  Irregular,    ///< Near a grid, but not on it: `places` holds them.
  Implausible,  ///< They make no grid in the order of the views.
};

/// Views of a grid at their stated positions.
struct ViewPlaces {
  PlacesKind kind = PlacesKind::Unknown;
  std::vector<ViewPlace> places;  ///< View by view in canonical order; empty unless irregular.
  double largest_deviation = 0;   ///< From the regular grid about the center view, in steps.
  int outliers = 0;               ///< Positions not believed and replaced by the place in the grid.
};

/// Turns stated positions into places. The step is the mean distance of neighbors along u (least
/// squares), or along v of a single column. Both directions share it, as disparity is px per step:
/// rows twice as far apart as columns lie two steps apart. The direction and the unit of positions
/// do not matter. A position farther than half a step from the plane through all of them is an
/// outlier. Positions are implausible if fewer than nine tenths fit, if steps are zero or not
/// finite, if the grid is skewed by more than a third, or if the ratio of the steps is beyond 2.
[[nodiscard]] ViewPlaces view_places(const LightFieldInfo& info, GridShape grid);

}  // namespace episcope
