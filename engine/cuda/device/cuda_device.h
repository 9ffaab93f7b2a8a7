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

/// Whether there is one. Asked once, then remembered.
[[nodiscard]] bool has_cuda_device();

}  // namespace episcope
