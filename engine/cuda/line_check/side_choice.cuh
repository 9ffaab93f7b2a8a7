// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/cuda/line_check/packed_field.cuh"

namespace episcope::cuda {

/// Decides for every ray near a jump of `before` to which side of it the ray belongs, and writes
/// disparity and confidence of all rays to `after`, which is another; see choose_sides. `variance`
/// is residual_noise of `before`.
void choose_sides(const PackedField& field, const MapPointers& before, float variance,
                  const MapPointers& after, const DeviceStream& stream);

}  // namespace episcope::cuda
