// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/camera_grid.h"
#include "engine/core/progress.h"
#include "engine/scenes/builtin.h"
#include "engine/scenes/stage.h"

namespace episcope::scenes {

/// The camera grid of a stage: eq. 1 with every disparity times `disparity_scale`.
[[nodiscard]] CameraGrid camera_grid_of(const Stage& stage, double disparity_scale);

/// Samples and truth of every view. `info` and scribbles are left to the caller.
struct Cast {
  ViewStack<std::uint8_t> samples;
  GroundTruth truth;
};

/// Throws Cancelled.
[[nodiscard]] Cast cast_views(const Stage& stage, const Model& model, const RenderOptions& options,
                              const Progress& progress);

}  // namespace episcope::scenes
