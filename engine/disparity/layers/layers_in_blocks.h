// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/disparity/common/blockwise.h"
#include "engine/disparity/layers/epi_two_layer.h"

namespace episcope {

/// EPI_TWO_LAYER in blocks: single and double orientations in bands of rows, of which the coherence
/// before the check of lines is kept; then views by themselves, which need up to 16 others each.
/// Refers to the light field. Throws as `estimate_epi_two_layer`.
[[nodiscard]] BlockwiseRun two_layers_in_blocks(const LightField& light_field,
                                                const EpiTwoLayerParameters& parameters,
                                                ViewSelection views, const Progress& progress);

}  // namespace episcope
