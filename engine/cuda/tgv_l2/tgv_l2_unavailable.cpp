// SPDX-License-Identifier: BSD-3-Clause
#include "engine/cuda/device/cuda_device.h"
#include "engine/cuda/tgv_l2/tgv_l2.h"

namespace episcope::cuda {

void solve_tgv_l2(Image<float>&, const TgvTask&, int, const Progress&) {
  throw DeviceFailure(known_cuda_device().why_not);
}

}  // namespace episcope::cuda
