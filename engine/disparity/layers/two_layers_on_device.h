// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/disparity/layers/layer_search.h"

namespace episcope {

/// EPI_TWO_LAYER on the device, from the samples to the result, once the range is known. `tensor`
/// is that of single orientations, with the range. Throws as estimate_epi_two_layer, DeviceFailure.
[[nodiscard]] Estimate two_layers_on_device(const LightField& light_field,
                                            const EpiTwoLayerParameters& parameters,
                                            const LayerSearch& search, ViewSelection views,
                                            const Progress& progress);

}  // namespace episcope
