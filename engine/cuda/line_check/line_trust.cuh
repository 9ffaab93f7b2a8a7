// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/cuda/line_check/packed_field.cuh"

namespace episcope::cuda {

/// Multiplies confidences by the trust in the maps' disparities, `variance` being residual_noise of
/// these; see reduce_confidence.
void reduce_confidence(const PackedField& field, const MapPointers& maps, float variance,
                       const DeviceStream& stream);

}  // namespace episcope::cuda
