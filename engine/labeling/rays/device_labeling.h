// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/labeling/rays/label_costs.h"
#include "engine/labeling/rays/ray_labeling.h"

namespace episcope {

/// What the GPU is to do for all views besides solving the problem of each.
struct DeviceLabeling {
  const RayColors* colors = nullptr;  ///< Null = costs are those of each ray alone.
  int votes = 0;                      ///< Rounds of vote_along_rays.
};

/// Whether `parameters` ask for the GPU, and there is something to solve.
[[nodiscard]] bool is_for_device(const RayLabelingInput& input,
                                 const RayLabelingParameters& parameters);

/// Labels of all views, computed on the GPU (engine/cuda/rays/ray_labels.h): what solve_views with
/// own costs, or with those of the nearest views' rays, and votes give on the CPU, but for
/// rounding. Labels are ids. Throws DeviceFailure, Cancelled.
[[nodiscard]] RayLabeling label_on_device(const RayLabelingInput& input,
                                          const RayLabelingParameters& parameters,
                                          const DeviceLabeling& labeling, const Progress& progress);

}  // namespace episcope
