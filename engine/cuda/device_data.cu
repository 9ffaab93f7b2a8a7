// SPDX-License-Identifier: BSD-3-Clause
#include "engine/cuda/device_data.h"

#include "engine/cuda/device.cuh"
#include "engine/cuda/device_data.cuh"

#include <mutex>
#include <variant>

namespace episcope::cuda {
namespace {

DeviceArray<std::uint8_t> upload_stack(const void* host, std::size_t bytes,
                                       const DeviceStream& stream, const Progress& progress) {
  return upload(static_cast<const std::uint8_t*>(host), bytes, stream, progress);
}

// The one light field that is kept.
struct Kept {
  std::mutex lock;
  std::uint64_t identity = 0;
  std::shared_ptr<const DeviceLightField> light_field;
};

Kept& kept() {
  static Kept* const kept = new Kept;  // never freed: the driver may be gone before static objects
  return *kept;
}

constexpr int kThreads = 256;

__global__ __launch_bounds__(kThreads) void clamp_values(float* values, long count, float min,
                                                         float max) {
  const long at = static_cast<long>(blockIdx.x) * kThreads + threadIdx.x;
  if (at < count) values[at] = fminf(fmaxf(values[at], min), max);
}

}  // namespace

DeviceLightField::DeviceLightField(const LightField& lf, const Progress& progress) {
  samples_ = std::visit(
      [&](const auto& stack) {
        return upload_stack(stack.data(), stack.size() * sizeof(*stack.data()), stream_, progress);
      },
      lf.samples());
  valid_ = upload_stack(lf.valid().data(), lf.valid().empty() ? 0 : lf.valid().size(), stream_,
                        progress);
  view_ = {samples_.data(), valid_.data(), lf.sample_type(), lf.grid(),
           lf.height(),     lf.width(),    lf.channels()};
}

std::shared_ptr<const DeviceLightField> on_device(const LightField& lf, const Progress& progress) {
  Kept& cache = kept();
  const std::lock_guard lock(cache.lock);
  if (cache.identity != lf.identity()) {
    cache.light_field.reset();
    cache.light_field = std::make_shared<DeviceLightField>(lf, progress);
    cache.identity = lf.identity();
  }
  return cache.light_field;
}

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
