// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/estimate.h"
#include "engine/core/light_field.h"
#include "engine/core/progress.h"
#include "engine/disparity/estimator.h"

#include <memory>
#include <vector>

namespace episcope {

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
