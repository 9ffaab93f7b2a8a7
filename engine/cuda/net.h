// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/image.h"
#include "engine/core/progress.h"
#include "engine/cuda/net_task.h"

#include <memory>

namespace episcope::cuda {

/// As NetMaps.
struct NetAnswer {
  Image<float> disparity, confidence, second, second_probability;
};

/// The weights of `net` on the device, which is where it runs.
class DeviceNet {
 public:
  /// Copies them. Throws DeviceFailure, Cancelled.
  DeviceNet(const NetParts& parts, const Progress& progress);
  ~DeviceNet();
  DeviceNet(const DeviceNet&) = delete;
  DeviceNet& operator=(const DeviceNet&) = delete;

  /// As estimate_net, or polish_by_net where a map is given: the same formulas, sums in another
  /// order. A volume that is larger than the free memory is computed in bands of rows, with the
  /// same bits. Thread-safe. Throws DeviceFailure, Cancelled.
  [[nodiscard]] NetAnswer run(const NetTask& task, const Progress& progress) const;

 private:
  struct Memory;
  std::unique_ptr<Memory> memory_;
};

}  // namespace episcope::cuda
