// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/capture/rectify/patch.h"
#include "engine/core/light_field/light_field.h"
#include "engine/core/parallel/progress.h"

#include <optional>
#include <vector>

namespace episcope::capture {

/// Points of the centre view, followed through all views.
struct ViewMatches {
  GridShape grid;
  std::vector<PlanePoint> points;  ///< In the centre view, px.
  /// By view (row by row) and point; nothing where a point was not found.
  std::vector<std::vector<std::optional<PatchMatch>>> found;

  [[nodiscard]] const std::vector<std::optional<PatchMatch>>& of(ViewIndex view) const {
    return found[static_cast<std::size_t>(view.v) * grid.u + view.u];
  }
};

/// Finds corners of the centre view in all others; the parallax of neighbours may be up to an
/// eighth of the width. Throws InvalidInput if fewer than 30 points can be followed; Cancelled.
[[nodiscard]] ViewMatches match_views(const LightField& field, const Progress& progress);

/// Differences in y of the same point in horizontal neighbours, absolute, in px, ascending.
[[nodiscard]] std::vector<double> vertical_disparities(const ViewMatches& matches);

/// The median gain of each view against the centre view, row by row.
[[nodiscard]] std::vector<double> view_gains(const ViewMatches& matches);

}  // namespace episcope::capture
