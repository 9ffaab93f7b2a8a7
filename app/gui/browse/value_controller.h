// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/gui/shell/jobs.h"
#include "app/gui/shell/workbench.h"
#include "app/session/open_scene.h"
#include "engine/core/estimate.h"
#include "engine/core/light_field.h"
#include "engine/core/scene.h"
#include "engine/render/shade.h"

#include <optional>

namespace episcope {

/// Disparity of one pixel; none outside the field or where it is invalid.
[[nodiscard]] inline std::optional<double> disparity_at(const DisparityField& field, ViewIndex view,
                                                        PixelIndex pixel) {
  if (!field.contains(view)) return std::nullopt;
  const DisparityView map = field.view(view);
  if (pixel.y >= map.disparity.height || pixel.x >= map.disparity.width) return std::nullopt;
  if (!map.is_valid(pixel.y, pixel.x)) return std::nullopt;
  return map.disparity.at(pixel.y, pixel.x);
}

/// Disparities of the first and, where two surfaces are visible, the second surface of a pixel.
struct DisparityPair {
  std::optional<double> front;
  std::optional<double> behind;
};

[[nodiscard]] inline DisparityPair disparities_at(const GroundTruth& truth, ViewIndex view,
                                                  PixelIndex pixel) {
  const auto single = disparity_at(truth.field, view, pixel);
  const auto front = disparity_at(truth.foreground, view, pixel);
  const auto behind = disparity_at(truth.background, view, pixel);
  if (front && behind) return {front, behind};
  return {single ? single : front ? front : behind, {}};
}

[[nodiscard]] inline DisparityPair disparities_at(const Estimate& estimate, ViewIndex view,
                                                  PixelIndex pixel) {
  DisparityPair pair{disparity_at(estimate.field, view, pixel), {}};
  const auto& layers = estimate.layered.layers;
  if (!pair.front || layers.empty() || !layers.contains(view)) return pair;
  if (layers.view(view).at(pixel.y, pixel.x) == 2) {
    pair.behind = disparity_at(estimate.layered.background, view, pixel);
  }
  return pair;
}

}  // namespace episcope
