// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace episcope {

/// All launches of one kernel: how long it took on the device, and what it had to do at least.
struct KernelTime {
  std::string name;
  int launches = 0;
  double milliseconds = 0;
  double bytes = 0;       ///< Read and written in the device's memory, each once.
  double operations = 0;  ///< Floating-point, single precision.
};

/// Begins to take times of kernels anew, or ends it. For benchmarks: it costs a little time.
void time_kernels(bool on);

/// What ran since `time_kernels(true)`, in the order of first launches. Waits for the device.
[[nodiscard]] std::vector<KernelTime> kernel_times();

}  // namespace episcope
