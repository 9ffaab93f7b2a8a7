// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/scene.h"
#include "engine/cuda/device.h"
#include "tests/cuda/cases.h"

#include <functional>
#include <vector>

namespace episcope::cuda_tests {

/// What a run on the device takes, the light field already there, and on the CPU of the machine.
struct Timing {
  double seconds = 0;         ///< Least of several, until the results are on the host.
  double kernel_seconds = 0;  ///< Of that, what kernels ran.
  double cpu_seconds = 0;     ///< 0 = not measured.
  std::vector<KernelTime> kernels;
};
[[nodiscard]] Timing time_case(const Case& each, const Scene& scene, bool with_cpu);

/// Likewise of anything that can be run on either device.
[[nodiscard]] Timing time_runs(const std::function<void(Device)>& run, bool with_cpu);

}  // namespace episcope::cuda_tests
