// SPDX-License-Identifier: BSD-3-Clause
#include "tests/cuda/timing.h"

#include "engine/core/progress.h"

#include <algorithm>

namespace episcope::cuda_tests {
namespace {

double seconds_of(const std::function<void(Device)>& run, Device device) {
  const Stopwatch watch;
  run(device);
  return watch.seconds();
}

}  // namespace

Timing time_runs(const std::function<void(Device)>& run, bool with_cpu) {
  constexpr int kRuns = 4;
  Timing timing;
  run(Device::Cuda);  // uploads
  timing.seconds = seconds_of(run, Device::Cuda);
  for (int i = 1; i < kRuns; ++i) {
    timing.seconds = std::min(timing.seconds, seconds_of(run, Device::Cuda));
  }
  time_kernels(true);
  run(Device::Cuda);
  timing.kernels = kernel_times();
  time_kernels(false);
  for (const KernelTime& kernel : timing.kernels)
    timing.kernel_seconds += kernel.milliseconds / 1e3;
  if (with_cpu) timing.cpu_seconds = seconds_of(run, Device::Cpu);
  return timing;
}

Timing time_case(const Case& each, const Scene& scene, bool with_cpu) {
  const auto run = [&](Device device) {
    const Estimate estimate = each.estimator.run(
        *scene.light_field, each.values, {.views = each.views, .device = device}, Progress());
  };
  return time_runs(run, with_cpu);
}

}  // namespace episcope::cuda_tests
