// SPDX-License-Identifier: BSD-3-Clause
#include "engine/cuda/device/cuda_device.h"
#include "engine/cuda/messages/message_labeling.h"

namespace episcope::cuda {

MessageAnswer solve_by_messages(const MessageTask&, int, const Progress&) {
  throw DeviceFailure(known_cuda_device().why_not);
}

}  // namespace episcope::cuda
