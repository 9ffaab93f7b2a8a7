// SPDX-License-Identifier: BSD-3-Clause
#include "engine/cuda/maps/device_maps.h"

#include "engine/cuda/device/launch.cuh"
#include "engine/cuda/device/transfer.cuh"
#include "engine/cuda/maps/map_memory.cuh"

namespace episcope::cuda {
namespace {

constexpr int kThreads = 256;

__global__ __launch_bounds__(kThreads) void clamp_values(float* values, long count, float min,
                                                         float max) {
  const long at = static_cast<long>(blockIdx.x) * kThreads + threadIdx.x;
  if (at < count) values[at] = fminf(fmaxf(values[at], min), max);
}

}  // namespace

DeviceMaps::DeviceMaps(const ViewStack<float>& like) : memory_(std::make_unique<MapMemory>(like)) {}
DeviceMaps::~DeviceMaps() = default;
DeviceMaps::DeviceMaps(DeviceMaps&&) noexcept = default;

void DeviceMaps::clamp(float min, float max) {
  DeviceArray<float>& values = memory_->disparity;
  const auto count = static_cast<long>(values.size());
  launch(memory_->stream, {"clamp", 8.0 * count, 2.0 * count}, [&] {
    clamp_values<<<blocks_for(count, kThreads), kThreads, 0, memory_->stream.get()>>>(
        values.data(), count, min, max);
  });
}

std::future<void> DeviceMaps::begin_confidence(ViewStack<float>& confidence,
                                               const Progress& progress) const {
  return begin_copies(memory_->stream, [this, &confidence, progress](const DeviceStream& copies) {
    cuda::download(confidence, memory_->confidence, copies, progress);
  });
}

void DeviceMaps::download_disparity(ViewStack<float>& disparity, const Progress& progress) const {
  cuda::download(disparity, memory_->disparity, memory_->stream, progress);
}

}  // namespace episcope::cuda
