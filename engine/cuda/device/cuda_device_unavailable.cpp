// SPDX-License-Identifier: BSD-3-Clause
#include "engine/cuda/device/cuda_device.h"

namespace episcope {

CudaDevice cuda_device() {
  CudaDevice device;
  device.why_not = "this build has no CUDA";
  return device;
}

std::string cuda_runtime_version() {
  return {};
}

}  // namespace episcope
