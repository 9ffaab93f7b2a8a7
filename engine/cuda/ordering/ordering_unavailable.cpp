// SPDX-License-Identifier: BSD-3-Clause
#include "engine/cuda/device/cuda_device.h"
#include "engine/cuda/ordering/ordering.h"

namespace episcope::cuda {

double sweep_in_order(const LightField&, const OrderingSweeps&, const ViewStack<float>&,
                      const ViewStack<float>&, ViewStack<float>&, const Progress&) {
  throw DeviceFailure(known_cuda_device().why_not);
}

OrderedLines count_ordered_lines(const ViewStack<float>&, float, const Progress&) {
  throw DeviceFailure(known_cuda_device().why_not);
}

}  // namespace episcope::cuda
