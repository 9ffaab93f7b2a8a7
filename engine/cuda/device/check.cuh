// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/cuda/device/cuda_device.h"

#include <cuda_runtime.h>

#include <string>

namespace episcope::cuda {

/// Throws DeviceFailure unless `error` is success.
inline void check(cudaError_t error) {
  if (error == cudaSuccess) return;
  cudaGetLastError();  // so that the next call does not report it again
  if (error == cudaErrorMemoryAllocation) {
    throw DeviceFailure("the GPU has too little free memory for this light field");
  }
  throw DeviceFailure(std::string("the GPU failed: ") + cudaGetErrorString(error));
}

}  // namespace episcope::cuda
