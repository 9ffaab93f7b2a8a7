// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/image.h"
#include "engine/core/progress.h"
#include "engine/cuda/device.h"

#include <functional>

namespace episcope::cuda {

/// A LiftedProblem (engine/solvers/simplex_labeling.h) on the device, and when to stop.
struct LiftedTask {
  SharedVolume cost;         ///< `[y][label][x]`, at most 512 labels.
  ImageView<const float> g;  ///< `[y][x]`, on the host, contiguous.
  double smoothness = 0;
  int max_iterations = 1000;
  double gap = 1e-3;
  int check_every = 10;
};

/// A LiftedResult.
struct LiftedLabels {
  Image<int> labels;
  int iterations = 0;
  double energy = 0, bound = 0;
  bool converged = false;
};

/// As solve_lifted_labeling: the same iterations, energy, bound and gap; takes 6 floats per pixel
/// and label besides the costs. `report` gets iterations and gap whenever the gap is checked.
/// Throws DeviceFailure, Cancelled.
[[nodiscard]] LiftedLabels solve_lifted(const LiftedTask& task,
                                        const std::function<void(int, double)>& report,
                                        const Progress& progress);

}  // namespace episcope::cuda
