// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/cuda/line_check/packed_field.cuh"

namespace episcope::cuda {

/// The median residual of the centre view, which the maps must cover; 0 if no ray has one. Waits
/// for the device. Throws DeviceFailure.
[[nodiscard]] float residual_noise(const PackedField& field, const MapPointers& maps,
                                   const DeviceStream& stream);

}  // namespace episcope::cuda
