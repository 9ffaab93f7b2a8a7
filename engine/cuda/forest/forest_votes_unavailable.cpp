// SPDX-License-Identifier: BSD-3-Clause
#include "engine/cuda/device/cuda_device.h"
#include "engine/cuda/forest/forest_votes.h"

namespace episcope::cuda {

struct DeviceForest::Memory {};

DeviceForest::DeviceForest(const ForestTables&, const Progress&) {
  throw DeviceFailure(known_cuda_device().why_not);
}
DeviceForest::~DeviceForest() = default;

void DeviceForest::vote(VolumeView<const float>, const Progress&, float*) const {
  throw DeviceFailure(known_cuda_device().why_not);
}

}  // namespace episcope::cuda
