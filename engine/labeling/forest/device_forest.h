// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/parallel/progress.h"
#include "engine/cuda/forest/forest_votes.h"
#include "engine/labeling/forest/forest_kernel.h"

#include <memory>

namespace episcope {

/// A forest on the GPU (engine/cuda/forest/forest_votes.h), whose votes have the same bits as the
/// kernel's. Throws DeviceFailure, Cancelled.
[[nodiscard]] std::shared_ptr<const cuda::DeviceForest> copy_to_device(const FlatForest& forest,
                                                                       const Progress& progress);

}  // namespace episcope
