// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/estimate.h"
#include "engine/scenes/builtin.h"

#include <memory>

/// A built-in scene of a few small views: quick to make, with truth and labels.
inline std::shared_ptr<const episcope::Scene> tiny_scene(const std::string& id = "edge",
                                                         episcope::GridShape grid = {3, 3}) {
  episcope::scenes::RenderOptions options;
  options.grid = grid;
  options.height = options.width = 64;
  return std::make_shared<const episcope::Scene>(
      episcope::scenes::render_builtin(id, options, episcope::Progress()));
}

/// An estimate of all views that is `offset` px off the truth everywhere.
inline episcope::EstimatePtr shifted_truth(const episcope::Scene& scene, float offset) {
  auto estimate = std::make_shared<episcope::Estimate>();
  estimate->field.disparity = scene.truth->field.disparity.clone();
  estimate->field.valid = scene.truth->field.valid.clone();
  float* values = estimate->field.disparity.data();
  for (std::size_t i = 0; i < estimate->field.disparity.size(); ++i) values[i] -= offset;
  estimate->method = "epi_l";
  return estimate;
}
