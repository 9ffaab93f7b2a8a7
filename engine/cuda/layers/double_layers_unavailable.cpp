// SPDX-License-Identifier: BSD-3-Clause
#include "engine/cuda/device/cuda_device.h"
#include "engine/cuda/layers/double_layers.h"

namespace episcope::cuda {

struct LayerMemory {};

DeviceLayers::DeviceLayers(const LightField&, const std::vector<DoublePass>&, const DoubleShears&,
                           DeviceMaps&, const Progress&) {
  throw DeviceFailure(known_cuda_device().why_not);
}
DeviceLayers::~DeviceLayers() = default;
DeviceLayers::DeviceLayers(DeviceLayers&&) noexcept = default;

void measure_double_layers(const LightField&, const std::vector<DoublePass>&, const DoubleShears&,
                           const DoubleResults&, const Progress&) {
  throw DeviceFailure(known_cuda_device().why_not);
}

}  // namespace episcope::cuda
