// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/cuda/line_check/packed_field.cuh"

namespace episcope::cuda {

/// Writes the disparities of `maps`, which cover all views, to `out`, those that other views see
/// through replaced; see replace_occluded. `variance` is residual_noise of the maps.
void replace_seen_through(const PackedField& field, const MapPointers& maps, float variance,
                          float* out, const DeviceStream& stream);

}  // namespace episcope::cuda
