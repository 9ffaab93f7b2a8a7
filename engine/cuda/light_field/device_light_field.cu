// SPDX-License-Identifier: BSD-3-Clause
#include "engine/cuda/device/transfer.cuh"
#include "engine/cuda/light_field/device_light_field.cuh"

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

}  // namespace episcope::cuda
