// SPDX-License-Identifier: BSD-3-Clause
#include "tests/cuda/timing.h"

#include "engine/core/parallel/stopwatch.h"

#include <algorithm>

namespace episcope::cuda_tests {
namespace {

double seconds_on(Device device, const Case& each, const Scene& scene) {
  const Stopwatch watch;
  const Estimate estimate = each.estimator.run(*scene.light_field, each.values,
                                               {.views = each.views, .device = device}, Progress());
  return watch.seconds();
}

}  // namespace

Timing time_case(const Case& each, const Scene& scene, bool with_cpu) {
  constexpr int kRuns = 4;
  Timing timing;
  seconds_on(Device::Cuda, each, scene);  // uploads
  timing.seconds = seconds_on(Device::Cuda, each, scene);
  for (int i = 1; i < kRuns; ++i) {
    timing.seconds = std::min(timing.seconds, seconds_on(Device::Cuda, each, scene));
  }
  time_kernels(true);
  seconds_on(Device::Cuda, each, scene);
  timing.kernels = kernel_times();
  time_kernels(false);
  for (const KernelTime& kernel : timing.kernels)
    timing.kernel_seconds += kernel.milliseconds / 1e3;
  if (with_cpu) timing.cpu_seconds = seconds_on(Device::Cpu, each, scene);
  return timing;
}

}  // namespace episcope::cuda_tests
