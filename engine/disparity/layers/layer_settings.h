// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/disparity/layers/double_orientation.h"
#include "engine/disparity/layers/epi_two_layer.h"

#include <cstdint>
#include <string>
#include <vector>

namespace episcope {

/// What EPI_TWO_LAYER on the CPU and on the device have in common.

/// Variation of the surface across the border of its region, and of either layer at least.
inline constexpr float kLayerBorderWeight = 0.02F;
/// Of data, as in EPI_S.
inline constexpr float kLeastLayerWeight = 0.003F;
/// Of two orientations, which are harder to tell from noise than one.
inline constexpr double kCrossScaleOfLayers = 1;
/// The region must be right to a pixel, not to a thousandth.
inline constexpr int kRegionIterations = 10;
inline constexpr double kRegionGap = 1e-3;

/// Filters for two orientations.
[[nodiscard]] TensorScales scales_of_layers(const EpiTwoLayerParameters& parameters);
/// Where both are looked for: cut off at the range itself, noise about its ends would no longer
/// average out.
[[nodiscard]] DoubleSearch layer_search(const EpiTwoLayerParameters& parameters, Interval range);
/// Notes of a result, from the gaps of its views.
[[nodiscard]] std::vector<std::string> layer_notes(const std::vector<double>& gaps,
                                                   const ViewStack<std::uint8_t>& layers);

}  // namespace episcope
