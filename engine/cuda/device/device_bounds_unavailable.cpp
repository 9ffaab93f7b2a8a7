// SPDX-License-Identifier: BSD-3-Clause
#include "engine/cuda/device/device_bounds.h"

#include "engine/cuda/device/cuda_device.h"

namespace episcope {

DeviceBounds measure_device_bounds() {
  throw DeviceFailure(known_cuda_device().why_not);
}

}  // namespace episcope
