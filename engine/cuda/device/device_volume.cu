// SPDX-License-Identifier: BSD-3-Clause
#include "engine/cuda/device/device_volume.cuh"

#include "engine/cuda/device/transfer.cuh"

namespace episcope::cuda {

SharedVolume upload_volume(VolumeView<const float> volume, const Progress& progress) {
  auto copy = std::make_shared<DeviceVolume>(volume.height, volume.layers, volume.width);
  upload_bytes(copy->values.data(), volume.data, copy->values.byte_size(), copy->stream, progress);
  return copy;
}

}  // namespace episcope::cuda
