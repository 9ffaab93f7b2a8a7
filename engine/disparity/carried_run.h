// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/estimate.h"
#include "engine/core/indices.h"
#include "engine/core/light_field.h"
#include "engine/core/progress.h"
#include "engine/disparity/estimator.h"
#include "engine/disparity/view_samples.h"

#include <memory>
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

/// A method that estimates single views. All others are carried from few of them: the first one
/// and, with `has_corners`, the corners of the grid (carried_run). Refers to its light field.
class CarriedMethod {
 public:
  virtual ~CarriedMethod() = default;
  CarriedMethod(const CarriedMethod&) = delete;
  CarriedMethod& operator=(const CarriedMethod&) = delete;

  [[nodiscard]] virtual ViewIndex first_view() const = 0;
  [[nodiscard]] virtual Interval range() const = 0;
  [[nodiscard]] virtual const LightField& compared() const = 0;

  /// The map of the first view, with confidence, range and notes. Throws DeviceFailure, Cancelled.
  [[nodiscard]] virtual Estimate estimate_first(const Progress& progress) = 0;
  /// The map of another view, with confidence, by what `maps` of others, the first view's among
  /// them, show there. Throws likewise.
  [[nodiscard]] virtual Estimate estimate_next(ViewIndex view, const std::vector<Estimate>& maps,
                                               const Progress& progress) = 0;

  /// What the estimate of the first view has found that all others need; and the state that it
  /// left, in another program. Throws Cancelled.
  [[nodiscard]] virtual std::vector<double> facts() const { return {}; }
  virtual void restore(const std::vector<double>& /*facts*/, const Progress& /*progress*/) {}

  /// Whether the corners of the grid are estimated, too, before all other views are carried.
  [[nodiscard]] virtual bool has_corners() const { return true; }
  /// Share of another view in the work of the first.
  [[nodiscard]] virtual double share_of_next() const { return 1; }
  /// Bytes that the estimate of a view takes beside large arrays (memory.h).
  [[nodiscard]] virtual double bytes_of_view() const = 0;

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

/// The same in blocks. Views are estimated one after the other, each of which is kept when it is
/// done; then all others are carried, view by view; then sides are chosen in bands of rows of all
/// views. Of a view at once it needs what its estimate needs, of which large arrays go to disk
/// beyond the memory budget. Bands need maps and samples of all views as far beyond them as
/// disparities reach; rows above that the pass has replaced are still in memory, or, in a program
/// that continues, carried again. Takes no result early.
[[nodiscard]] BlockwiseRun carried_in_blocks(const LightField& light_field,
                                             std::unique_ptr<CarriedMethod> method,
                                             ViewSelection views, int threads);

}  // namespace episcope
