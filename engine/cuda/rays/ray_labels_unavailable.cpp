// SPDX-License-Identifier: BSD-3-Clause
#include "engine/cuda/device/cuda_device.h"
#include "engine/cuda/rays/ray_labels.h"

namespace episcope::cuda {

RayLabelsAnswer label_rays(const RayLabelsTask&, const Progress&, ViewStack<std::int32_t>&) {
  throw DeviceFailure(known_cuda_device().why_not);
}

}  // namespace episcope::cuda
