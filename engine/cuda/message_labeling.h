// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/image.h"
#include "engine/core/progress.h"
#include "engine/cuda/device.h"

namespace episcope::cuda {

/// MessageProblem on the device (engine/solvers/message_labeling.h).
struct MessageTask {
  const DeviceVolume& cost;  ///< `[y][label][x]`, at most 512 labels.
  ImageView<const float> across, down;
  float slope = 1;
  float most = 1;
};

/// As MessageResult.
struct MessageAnswer {
  Image<int> labels;
  int iterations = 0;
  double energy = 0;
  double bound = 0;
};

/// `solve_by_messages` on the device: rows follow one another a pixel apart. Throws DeviceFailure,
/// Cancelled.
[[nodiscard]] MessageAnswer solve_by_messages(const MessageTask& task, int iterations,
                                              const Progress& progress);

}  // namespace episcope::cuda
