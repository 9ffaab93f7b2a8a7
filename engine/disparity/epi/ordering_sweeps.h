// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/disparity/epi/epi_c.h"
#include "engine/solvers/ordering/ordering_terms.h"

#include <array>
#include <vector>

namespace episcope {

/// A line violates the ordering where D u is below this, px.
inline constexpr float kOrderingViolation = -0.05F;
/// The least data weight. Less than in EPI_S: pixels that the views contradict should follow their
/// neighbours entirely.
inline constexpr float kOrderingLeastWeight = 0.001F;

/// From a view to its neighbours in the grid.
inline constexpr std::array<ViewIndex, 4> kNeighbourWays = {{{0, 1}, {0, -1}, {1, 0}, {-1, 0}}};
[[nodiscard]] inline ViewIndex neighbour(ViewIndex view, ViewIndex way) {
  return {view.v + way.v, view.u + way.u};
}
/// A point moves by −d per step of u or v.
[[nodiscard]] inline LineStep step_along(ViewIndex way) {
  return {way.v != 0, static_cast<float>(-(way.u + way.v))};
}

/// Views that EPI_C denoises: `u` is improved and covers their neighbours in the grid as well, `f`
/// is what was observed.
struct OrderedViews {
  const LightField& light_field;
  const EpiCParameters& parameters;
  const ViewStack<float>& f;
  const ViewStack<float>& confidence;
  ViewStack<float>& u;
  [[nodiscard]] OrderingPenalty penalty() const;
};

/// The views of a rectangle that have one colour (0 or 1) of the chequerboard of the grid.
[[nodiscard]] std::vector<ViewIndex> views_of_colour(const ViewRectangle& views, int colour);

/// Improves views of one colour, one after the other, as half a sweep of EPI_C; at
/// `progress.finish_requested()` those not yet reached stay as they are. Returns the largest
/// relative gap. Throws Cancelled.
double improve(const OrderedViews& work, const std::vector<ViewIndex>& views,
               const Progress& progress);

/// Lines from some views that stay within the image, and those that violate the ordering.
struct LineCount {
  long violations = 0, lines = 0;
  LineCount& operator+=(const LineCount& other);
  [[nodiscard]] double share() const;
};
/// Of one view; `disparity` covers its neighbours as well. `scratch` has the size of a view.
[[nodiscard]] LineCount count_lines(const ViewStack<float>& disparity, ViewIndex view,
                                    Image<float>& scratch);

/// Calls visit(neighbour, way) for the neighbours of a view whose lines count.
template <class Visit>
void for_each_neighbour(const OrderedViews& work, ViewIndex view, const Visit& visit) {
  for (const ViewIndex way : kNeighbourWays) {
    const ViewIndex other = neighbour(view, way);
    if (work.u.contains(other) && count_valid(work.light_field, other) > 0) visit(other, way);
  }
}

}  // namespace episcope
