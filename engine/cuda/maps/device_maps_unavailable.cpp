// SPDX-License-Identifier: BSD-3-Clause
#include "engine/cuda/device/cuda_device.h"
#include "engine/cuda/maps/device_maps.h"

namespace episcope::cuda {

struct MapMemory {};

DeviceMaps::DeviceMaps(const ViewStack<float>&) {
  throw DeviceFailure(known_cuda_device().why_not);
}
DeviceMaps::~DeviceMaps() = default;
DeviceMaps::DeviceMaps(DeviceMaps&&) noexcept = default;

void DeviceMaps::clamp(float, float) {}

std::future<void> DeviceMaps::begin_confidence(ViewStack<float>&, const Progress&) const {
  return {};
}

void DeviceMaps::download_disparity(ViewStack<float>&, const Progress&) const {}

}  // namespace episcope::cuda
