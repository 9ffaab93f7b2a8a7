// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/light_field.h"
#include "engine/core/progress.h"
#include "engine/core/view_stack.h"

#include <cstdint>
#include <functional>
#include <vector>

namespace episcope::cuda {

/// The sweeps of EPI_C; see EpiCParameters and OrderingPenalty.
struct OrderingSweeps {
  float rise = 0, fall = 0.1F, softness = 0.05F;
  int sweeps = 2;
  double lambda = 0.05;
  double weight_power = 4;
  float min_weight = 0.001F;
  double edge_strength = 15;
  int max_iterations = 24;
  double gap = 1e-4;
  /// `[view]`: whether lines that end there count.
  std::vector<std::uint8_t> counts;
  /// Told before each half of a sweep, with the largest relative gap so far.
  std::function<void(int half, double gap)> on_half;
};

/// Improves `u`, a first guess of the disparity of all views, on the device, to follow `observed`
/// with weights from `confidence` under the occlusion ordering; all cover all views. Returns the
/// largest relative duality gap of the last sweep. At `progress.finish_requested()` the views not
/// yet reached stay as they are. Throws DeviceFailure, Cancelled.
[[nodiscard]] double sweep_in_order(const LightField& light_field, const OrderingSweeps& sweeps,
                                    const ViewStack<float>& observed,
                                    const ViewStack<float>& confidence, ViewStack<float>& u,
                                    const Progress& progress);

/// Lines to neighboring views that stay within the image, and how many have D u < `limit`, px.
struct OrderedLines {
  long violations = 0, lines = 0;
};
[[nodiscard]] OrderedLines count_ordered_lines(const ViewStack<float>& disparity, float limit,
                                               const Progress& progress);

}  // namespace episcope::cuda
