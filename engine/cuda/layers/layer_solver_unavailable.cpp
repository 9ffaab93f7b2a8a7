// SPDX-License-Identifier: BSD-3-Clause
#include "engine/cuda/device/cuda_device.h"
#include "engine/cuda/layers/layer_solver.h"

namespace episcope::cuda {

LayerOutcome solve_layers(const LightField&, const LayerSmoothing&, const RawLayers&, DeviceMaps,
                          const LayerResults&, const Progress&) {
  throw DeviceFailure(known_cuda_device().why_not);
}

}  // namespace episcope::cuda
