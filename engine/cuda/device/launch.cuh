// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/cuda/device/check.cuh"
#include "engine/cuda/device/device_stream.cuh"

namespace episcope::cuda {

/// What a launch has to do at least, for `kernel_times`.
struct KernelWork {
  const char* name;       ///< A literal.
  double bytes = 0;       ///< Read and written, each once.
  double operations = 0;  ///< Floating-point.
};

/// A launch that is timed while `time_kernels` is on; begin with construction, end with `finish`.
class TimedLaunch {
 public:
  TimedLaunch(const DeviceStream& stream, const KernelWork& work);
  void finish();

 private:
  cudaStream_t stream_;
  int entry_ = -1;
};

/// Launches: `launch()` holds one kernel<<<…>>> call on the stream. Throws DeviceFailure.
template <class Launch>
void launch(const DeviceStream& stream, const KernelWork& work, const Launch& kernel) {
  TimedLaunch timed(stream, work);
  kernel();
  check(cudaGetLastError());
  timed.finish();
}

/// Blocks of `size` that cover `count`.
constexpr unsigned blocks_for(long count, int size) {
  return static_cast<unsigned>((count + size - 1) / size);
}

}  // namespace episcope::cuda
