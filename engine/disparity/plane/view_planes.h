// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/light_field/estimate.h"
#include "engine/core/parallel/progress.h"
#include "engine/disparity/plane/evened_views.h"
#include "engine/disparity/plane/plane_parameters.h"

#include <vector>

namespace episcope {

/// The map of the view that `data` was begun for (steps 1 to 3 of plane_pm.h). `known` shows what
/// occludes from the start; without data if nothing is known. What the first round tells of the
/// brightness of the views goes into `data`. At `progress.finish_requested()` the map of the last
/// round that was finished. Throws DeviceFailure, Cancelled.
[[nodiscard]] Estimate estimate_view(EvenedViews& data, const PlaneParameters& parameters,
                                     const MapOfView& known, const Progress& progress);

/// The map of another view in one round: what `maps`, of which there is one at least, show there
/// occludes. `light_field`: as it is compared, evened. Throws likewise.
[[nodiscard]] Estimate estimate_next_view(const LightField& light_field,
                                          const PlaneParameters& parameters, Device device,
                                          ViewIndex view, const std::vector<Estimate>& maps,
                                          const Progress& progress);

/// The corners of the grid but `from`: the views that see most of what it does not.
[[nodiscard]] std::vector<ViewIndex> outermost_views(GridShape grid, ViewIndex from);

}  // namespace episcope
