// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/disparity/layers/double_orientation.h"
#include "engine/disparity/layers/epi_two_layer.h"

namespace episcope {

/// What EPI_TWO_LAYER looks for in a light field.
struct LayerSearch {
  EpiLParameters single;  ///< Of orientations, whose range is settled.
  EpiLParameters fit;     ///< Of their coherence beside that of double ones.
  TensorScales double_scales;
  DoubleSearch doubles;
};

/// Throws as `search_layer_range`.
[[nodiscard]] LayerSearch begin_layer_search(const LightField& light_field,
                                             const EpiTwoLayerParameters& parameters,
                                             const Progress& progress, Device device);

}  // namespace episcope
