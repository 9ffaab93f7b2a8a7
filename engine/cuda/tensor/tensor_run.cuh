// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/parallel/progress.h"
#include "engine/cuda/light_field/device_light_field.cuh"
#include "engine/cuda/maps/map_pointers.cuh"
#include "engine/cuda/tensor/orientations.h"

#include <functional>

namespace episcope::cuda {

/// Told that maps [first, first + count) will be done when what the stream was told so far is.
using MapsBegun = std::function<void(int first, int count)>;

/// `find_orientations` of what is on the device, on a stream, with the results, disparity and
/// coherence, left there.
/// `on_maps` hears of every map once. Throws DeviceFailure, Cancelled.
void find_orientations_on_device(const DeviceSamples& samples, const TensorSettings& settings,
                                 const MapPointers& maps, const DeviceStream& stream,
                                 const Progress& progress, const MapsBegun& on_maps = {});

}  // namespace episcope::cuda
