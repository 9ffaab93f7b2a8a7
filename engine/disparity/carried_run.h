// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/estimate.h"
#include "engine/core/indices.h"
#include "engine/core/light_field.h"
#include "engine/core/progress.h"
#include "engine/disparity/estimator.h"
#include "engine/disparity/view_samples.h"

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

/// A method that estimates single views. All others are carried from few of them: the first one
/// and, with `has_corners`, the corners of the grid (carried_run). Refers to its light field.
class CarriedMethod {
 public:
  virtual ~CarriedMethod() = default;
  CarriedMethod(const CarriedMethod&) = delete;
  CarriedMethod& operator=(const CarriedMethod&) = delete;

  [[nodiscard]] virtual ViewIndex first_view() const = 0;
  [[nodiscard]] virtual const LightField& compared() const = 0;

  /// The map of the first view, with confidence, range and notes. Throws DeviceFailure, Cancelled.
  [[nodiscard]] virtual Estimate estimate_first(const Progress& progress) = 0;
  /// The map of another view, with confidence, by what `maps` of others, the first view's among
  /// them, show there. Throws likewise.
  [[nodiscard]] virtual Estimate estimate_next(ViewIndex view, const std::vector<Estimate>& maps,
                                               const Progress& progress) = 0;

  /// Whether the corners of the grid are estimated, too, before all other views are carried.
  [[nodiscard]] virtual bool has_corners() const { return true; }
  /// Share of another view in the work of the first.
  [[nodiscard]] virtual double share_of_next() const { return 1; }

 protected:
  CarriedMethod() = default;
};

/// Estimates the first view alone or, for all, also the corners of the grid, each with what the
/// maps made before show there; carries these to every view (propagate_to_views), and lets the
/// samples decide beside jumps (choose_propagated_sides). Views that were estimated keep their own
/// maps. At `progress.finish_requested()` all are carried from the views that are done. Throws
/// DeviceFailure, Cancelled.
[[nodiscard]] Estimate run_carried(CarriedMethod& method, ViewSelection views,
                                   const Progress& progress);

}  // namespace episcope
