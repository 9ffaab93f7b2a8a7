// SPDX-License-Identifier: BSD-3-Clause
#include "engine/cuda/device/cuda_device.h"
#include "engine/cuda/tensor/orientations.h"

namespace episcope::cuda {

void find_orientations(const LightField&, const TensorSettings&, ViewStack<float>&,
                       ViewStack<float>&, const Progress&) {
  throw DeviceFailure(known_cuda_device().why_not);
}

void find_orientations(const LightField&, const TensorSettings&, DeviceMaps&, const Progress&) {
  throw DeviceFailure(known_cuda_device().why_not);
}

}  // namespace episcope::cuda
