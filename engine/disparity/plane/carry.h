// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/array/view_rectangle.h"
#include "engine/core/light_field/estimate.h"
#include "engine/core/parallel/progress.h"

#include <string>
#include <vector>

namespace episcope {

/// Carries maps of single views to the `views`: `disparity` and `confidence`, `[v][u][y][x]`. Each
/// of `maps` (one view each, with confidence) falls into every view, the nearest of its points
/// first; where they differ, they vote by confidence and by the nearness of their views, and those
/// that agree are averaged. The view of the first map keeps it as it is. What no map shows
/// continues the farthest of the next known pixels to the left and right, above and below, with
/// confidence 0. Throws InvalidInput without maps, Cancelled.
struct CarriedMaps {
  ViewStack<float> disparity, confidence;
};
[[nodiscard]] CarriedMaps carry_to_views(const std::vector<Estimate>& maps, ViewRectangle views,
                                         const Progress& progress);

/// Puts the map of a single view in its place in maps of some views, whose row 0 is the row
/// `first_row` of the view. Does nothing if they do not hold the view.
void put_map(const Estimate& map, int first_row, ViewStack<float>& disparity,
             ViewStack<float>& confidence);

/// For the notes of an estimate that was carried from so many views.
[[nodiscard]] std::string carried_note(std::size_t views);

}  // namespace episcope
