// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace episcope {

/// What EPI_TWO_LAYER on the CPU and on the device have in common.

/// Variation of the surface across the border of its region, and of either layer at least.
inline constexpr float kLayerBorderWeight = 0.02F;
/// Of data, as in EPI_S.
inline constexpr float kLeastLayerWeight = 0.003F;
/// The region must be right to a pixel, not to a thousandth.
inline constexpr int kRegionIterations = 10;
inline constexpr double kRegionGap = 1e-3;

}  // namespace episcope
