// SPDX-License-Identifier: BSD-3-Clause
#include "engine/cuda/device/cuda_device.h"
#include "engine/cuda/lifted/lifted_solver.h"

namespace episcope::cuda {

LiftedLabels solve_lifted(const LiftedTask&, const std::function<void(int, double)>&,
                          const Progress&) {
  throw DeviceFailure(known_cuda_device().why_not);
}

}  // namespace episcope::cuda
