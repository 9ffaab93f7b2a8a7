// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/image.h"
#include "engine/core/progress.h"

namespace episcope::cuda {

/// `solve_tgv_l2` on the device (engine/solvers/tv_l2.h), the same steps: `f` becomes the
/// minimizer. All have one shape. Throws DeviceFailure, Cancelled.
struct TgvTask {
  ImageView<const float> w, g;
  double lambda = 0.1;
  double bend = 2;
};
void solve_tgv_l2(Image<float>& f, const TgvTask& task, int iterations, const Progress& progress);

}  // namespace episcope::cuda
