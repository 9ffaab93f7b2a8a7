// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/error.h"
#include "engine/core/image.h"
#include "engine/core/progress.h"

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

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

/// What the device can do at most, measured: what kernels are held against.
struct DeviceBounds {
  double bytes = 0;       ///< Copied within its memory a second, read and written.
  double operations = 0;  ///< FP32 a second; a multiply-add counts as two.
};

/// Measures them, in a tenth of a second. Throws DeviceFailure.
[[nodiscard]] DeviceBounds measure_device_bounds();

}  // namespace episcope

namespace episcope::cuda {

/// A volume `[y][layer][x]` in the memory of the device (device.cuh), complete and
/// immutable.
struct DeviceVolume;
using SharedVolume = std::shared_ptr<const DeviceVolume>;

/// Copies a volume to the device. Throws DeviceFailure, Cancelled.
[[nodiscard]] SharedVolume upload_volume(VolumeView<const float> volume, const Progress& progress);

}  // namespace episcope::cuda

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
