// SPDX-License-Identifier: BSD-3-Clause
#include "engine/cuda/device/cuda_device.h"
#include "engine/cuda/line_check/line_check.h"

namespace episcope::cuda {

void check_lines(const LightField&, const LineCheckSteps&, ViewStack<float>&, ViewStack<float>&,
                 const Progress&) {
  throw DeviceFailure(known_cuda_device().why_not);
}

void check_lines(const LightField&, const LineCheckSteps&, DeviceMaps&, const Progress&) {
  throw DeviceFailure(known_cuda_device().why_not);
}

void replace_occluded(const LightField&, ViewStack<float>&, const ViewStack<float>&,
                      const Progress&) {
  throw DeviceFailure(known_cuda_device().why_not);
}

}  // namespace episcope::cuda
