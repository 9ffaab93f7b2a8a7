// SPDX-License-Identifier: BSD-3-Clause
#include "engine/cuda/device/cuda_device.h"

#include <cuda_runtime.h>

namespace episcope {
namespace {

std::string version_text(int version) {
  return std::to_string(version / 1000) + "." + std::to_string(version % 1000 / 10);
}

// The compute capability that the oldest machine code is made for.
constexpr int kOldestMajor = 8;

}  // namespace

std::string cuda_runtime_version() {
  return version_text(CUDART_VERSION);
}

CudaDevice cuda_device() {
  CudaDevice device;
  int driver = 0, count = 0;
  device.runtime = cuda_runtime_version();
  if (cudaDriverGetVersion(&driver) != cudaSuccess || driver == 0) {
    device.why_not = "there is no NVIDIA driver";
    return device;
  }
  device.driver = version_text(driver);
  if (const cudaError_t error = cudaGetDeviceCount(&count); error != cudaSuccess || count == 0) {
    device.why_not = std::string("CUDA finds no GPU (") + cudaGetErrorString(error) + ")";
    return device;
  }
  cudaDeviceProp properties{};
  if (const cudaError_t error = cudaGetDeviceProperties(&properties, 0); error != cudaSuccess) {
    device.why_not = std::string("the GPU does not answer (") + cudaGetErrorString(error) + ")";
    return device;
  }
  device.name = properties.name;
  if (properties.major < kOldestMajor || !properties.memoryPoolsSupported) {
    device.why_not = device.name + " is too old (compute capability " +
                     std::to_string(properties.major) + "." + std::to_string(properties.minor) +
                     ", needed 8.0)";
    return device;
  }
  if (const cudaError_t error = cudaMemGetInfo(&device.free_memory, &device.memory);
      error != cudaSuccess) {
    device.why_not = device.name + " cannot be used (" + cudaGetErrorString(error) + ")";
    return device;
  }
  device.is_available = true;
  return device;
}

}  // namespace episcope
