// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/parallel/progress.h"
#include "engine/cuda/line_check/line_check.h"
#include "engine/cuda/line_check/packed_field.cuh"

namespace episcope::cuda {

/// `check_lines` of maps on the device, on a stream. Throws DeviceFailure, Cancelled.
void check_lines_on_device(const DeviceSamples& samples, const LineCheckSteps& steps,
                           const MapPointers& maps, const DeviceStream& stream,
                           const Progress& progress);

}  // namespace episcope::cuda
