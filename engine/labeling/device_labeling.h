// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/progress.h"
#include "engine/cuda/forest_votes.h"
#include "engine/labeling/forest_kernel.h"
#include "engine/labeling/ray_labeling.h"

#include <memory>

namespace episcope {

/// Work of the GPU for all views besides solving the problem of each.
struct DeviceLabeling {
  const RayColors* colors = nullptr;  ///< Null = each ray has its own costs only.
  int votes = 0;                      ///< Rounds of vote_along_rays.
};

/// Whether `parameters` ask for the GPU, and there is something to solve.
[[nodiscard]] bool is_for_device(const RayLabelingInput& input,
                                 const RayLabelingParameters& parameters);

/// Computes labels of all views on the GPU (engine/cuda/ray_labels.h): the result
/// of solve_views and votes on the CPU, but for rounding. Labels are ids. Throws DeviceFailure,
/// Cancelled.
[[nodiscard]] RayLabeling label_on_device(const RayLabelingInput& input,
                                          const RayLabelingParameters& parameters,
                                          const DeviceLabeling& labeling, const Progress& progress);

/// A forest on the GPU (engine/cuda/forest_votes.h), whose votes have the same bits as the
/// kernel's. Throws DeviceFailure, Cancelled.
[[nodiscard]] std::shared_ptr<const cuda::DeviceForest> copy_to_device(const FlatForest& forest,
                                                                       const Progress& progress);

}  // namespace episcope
