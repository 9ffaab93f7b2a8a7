// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/light_field/map_block.h"
#include "engine/core/parallel/progress.h"
#include "engine/disparity/common/run_options.h"
#include "engine/disparity/layers/double_orientation.h"

#include <cstddef>
#include <cstdint>

namespace episcope {

/// Double orientation of every ray, raw: meaningless where confidence is low. Confidence is stored
/// in 1/255, because three float maps of all views would not fit beside the results.
struct DoubleLayers {
  ViewStack<float> near;
  ViewStack<float> far;
  ViewStack<std::uint8_t> confidence;
};

/// Throws InvalidInput if neither axis of the grid has three views.
void require_double_grid(const LightField& light_field);

/// Measures horizontal and vertical EPIs (where the grid has the views) and merges them: where both
/// directions agree within 0.3 px in both layers their mean weighted by confidence^8, else the more
/// confident one. Covers the block; a device only blocks of whole views. Throws as
/// `require_double_grid`, Cancelled.
[[nodiscard]] DoubleLayers measure_double_layers(const LightField& light_field,
                                                 const TensorScales& scales,
                                                 const DoubleSearch& search, const MapBlock& block,
                                                 const Progress& progress,
                                                 Device device = Device::Cpu);

/// What measuring takes.
struct DoubleNeeds {
  std::size_t bytes = 0;  ///< Of each thread.
  int reach = 0;          ///< Rows above and below a block that it looks at.
};
[[nodiscard]] DoubleNeeds double_layers_need(const LightField& light_field,
                                             const TensorScales& scales,
                                             const DoubleSearch& search);

}  // namespace episcope
