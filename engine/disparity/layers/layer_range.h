// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/disparity/epi/epi_l.h"
#include "engine/disparity/layers/double_orientation.h"

namespace episcope {

/// The disparity range that a method for two layers should search: as `search_range`, but where the
/// range must be estimated from the light field, it is extended to the layers of those pixels of
/// the centre view whose two orientations, searched on every few tiles over ±`limit`, are
/// unambiguous: pixels behind a second surface are not coherent for any single disparity.
/// Throws as `require_double_grid`, Cancelled.
[[nodiscard]] Interval search_layer_range(const LightField& light_field,
                                          const EpiLParameters& parameters,
                                          const TensorScales& double_scales,
                                          const Progress& progress, Device device = Device::Cpu,
                                          double limit = 5);

}  // namespace episcope
