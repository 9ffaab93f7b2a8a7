// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/estimate.h"
#include "engine/core/indices.h"
#include "engine/core/progress.h"
#include "engine/disparity/view_samples.h"

#include <string>
#include <vector>

namespace episcope {

/// Propagates maps of single views to the `views`: `disparity` and `confidence`, `[v][u][y][x]`.
/// Each of `maps` (one view each, with confidence) falls into every view, the nearest of its points
/// first; where they differ, they vote by confidence and by the nearness of their views, and maps
/// that agree are averaged. The view of the first map keeps it as it is. A pixel that no map shows
/// continues the farthest of the next known pixels to the left and right, above and below, with
/// confidence 0. Throws InvalidInput without maps, Cancelled.
struct PropagatedMaps {
  ViewStack<float> disparity, confidence;
};
[[nodiscard]] PropagatedMaps propagate_to_views(const std::vector<Estimate>& maps,
                                                ViewRectangle views, const Progress& progress);

/// Puts the map of a single view in its place in maps of some views, whose row 0 is the row
/// `first_row` of the view. Does nothing if they do not hold the view.
void put_map(const Estimate& map, int first_row, ViewStack<float>& disparity,
             ViewStack<float>& confidence);

/// Note of an estimate that was propagated from so many views.
[[nodiscard]] std::string propagated_note(std::size_t views);

/// Decides to which side the pixels beside jumps belong, in maps of all views. A silhouette that
/// was propagated from another view is right to a pixel at best.
///
/// A pixel whose 5×5 px differ by more than 0.2 px of disparity can take the least or the largest
/// value among them, its own standing for the side that it is on. Each is judged by the mean over
/// the views in which it is visible, by the map of that view (0.2 px nearer hides it), of
/// min(cap, |difference of color|), samples bilinear; `cap` where none sees it. Costs are averaged
/// over such pixels of 5×5 px by their similarity in color, and the other side wins if its mean is
/// below 0.95 of the own one. All are judged by the estimate before the call, so that results do
/// not depend on the number of threads. Memory: a copy of the disparity. `cap`: samples in [0, 1],
/// Euclidean norm over the channels. Throws Cancelled.
void choose_propagated_sides(const PackedViews& views, float cap, Estimate& estimate,
                             const Progress& progress);

/// Rows of all views, of whole views of `height` rows: samples and the maps before the call, row 0
/// of both being `first_row`.
struct PropagatedRows {
  const PackedViews& views;
  const ViewStack<float>& before;
  int first_row = 0;
  int height = 0;
};
/// Chooses sides in a part of the rows, in place: row 0 of `disparity` is the row `begin` of the
/// views. `rows` must reach `propagated_reach` beyond them, or to the end of the views. Throws
/// Cancelled.
void choose_propagated_sides(const PropagatedRows& rows, float cap, int begin,
                             ViewStack<float>& disparity, const Progress& progress);

/// Number of rows looked at beyond the chosen ones if no disparity exceeds `farthest` px in size.
[[nodiscard]] int propagated_reach(GridShape grid, double farthest);

/// A cap for a light field: what the noise of a view explains, and a little more. Throws Cancelled.
[[nodiscard]] float propagated_cap(const LightField& light_field, ViewIndex view,
                                   const Progress& progress);

}  // namespace episcope
