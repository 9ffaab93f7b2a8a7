// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/cuda/stereo/view_planes.cuh"

namespace episcope::cuda {

/// surfaces_in_views of the reference view's `disparity` `[y][x]`, in the slots of `views`,
/// `[slot][y][x]`.
[[nodiscard]] DeviceArray<float> cast_surfaces(const ViewPlanes& views, const float* disparity,
                                               const DeviceStream& stream);

}  // namespace episcope::cuda
