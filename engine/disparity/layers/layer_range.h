// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/disparity/epi/epi_l.h"
#include "engine/disparity/layers/double_orientation.h"

namespace episcope {

/// The disparity range that a method for two layers should search: as `search_range`, but where
/// the range must be found from the light field, it is widened to the layers of those pixels of the
/// centre view whose two orientations, looked for on every few tiles over ±`limit`, leave no doubt:
/// pixels in front of which a second surface lies are coherent for no single disparity.
/// Throws as `require_double_grid`, Cancelled.
[[nodiscard]] Interval search_layer_range(const LightField& light_field,
                                          const EpiLParameters& parameters,
                                          const TensorScales& double_scales,
                                          const Progress& progress, double limit = 5);

}  // namespace episcope
