// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cuda_runtime.h>

namespace episcope::cuda {

/// What a run does on the device, in order. Every run has one of its own. Not copyable.
class DeviceStream {
 public:
  /// Throws DeviceFailure.
  DeviceStream();
  /// Waits for what was begun.
  ~DeviceStream();
  DeviceStream(const DeviceStream&) = delete;
  DeviceStream& operator=(const DeviceStream&) = delete;

  [[nodiscard]] cudaStream_t get() const { return stream_; }
  /// Waits for what was begun. Throws DeviceFailure if any of it failed.
  void wait() const;
  /// What is begun from now on waits for what was begun on the other. Throws DeviceFailure.
  void wait_for(const DeviceStream& other) const;

 private:
  cudaStream_t stream_ = nullptr;
};

}  // namespace episcope::cuda
