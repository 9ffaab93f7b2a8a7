// SPDX-License-Identifier: BSD-3-Clause
#include "engine/cuda/device/cuda_device.h"
#include "engine/cuda/stereo/volume_costs.h"

namespace episcope::cuda {

CostsAtLabels costs_at_labels(const DeviceVolume&, const Image<int>&, const Progress&) {
  throw DeviceFailure(known_cuda_device().why_not);
}

Image<int> least_labels(const DeviceVolume&, const Progress&) {
  throw DeviceFailure(cuda_device().why_not);
}

double sum_around_best(const DeviceVolume&, const std::uint8_t*, int, const Progress&) {
  throw DeviceFailure(known_cuda_device().why_not);
}

}  // namespace episcope::cuda
