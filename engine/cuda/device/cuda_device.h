// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/error.h"

#include <cstddef>
#include <string>

namespace episcope {

/// The device failed, or has too little memory. Where the device was not demanded, the CPU takes
/// over.
class DeviceFailure : public Unavailable {
 public:
  using Unavailable::Unavailable;
};

/// The GPU that methods compute on: the first that CUDA lists.
struct CudaDevice {
  bool is_available = false;
  std::string why_not;  ///< A clause: "this build has no CUDA"; empty if available.
  std::string name;     ///< "NVIDIA H200"
  std::size_t memory = 0, free_memory = 0;  ///< Bytes.
  std::string driver, runtime;              ///< Versions of CUDA: "13.0".
};

/// Asks for the device: the first call starts the driver, which takes up to a second. Never throws.
[[nodiscard]] CudaDevice cuda_device();

/// The device as it was when first asked for.
[[nodiscard]] inline const CudaDevice& known_cuda_device() {
  static const CudaDevice device = cuda_device();
  return device;
}

[[nodiscard]] inline bool has_cuda_device() {
  return known_cuda_device().is_available;
}

/// The version of CUDA that this build carries, without asking the driver; empty if it has none.
[[nodiscard]] std::string cuda_runtime_version();

}  // namespace episcope
