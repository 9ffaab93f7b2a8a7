// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/capture/view_surface.h"

#include <optional>

namespace episcope::capture {

/// The nearest hit of the ray from (x, y, 0) along (dx, dy, 1) on any triangle, from either side,
/// as its depth; by trying all (Möller, Trumbore: Fast, minimum storage ray-triangle intersection,
/// 1997). Shares nothing with the rasterizer.
[[nodiscard]] std::optional<double> exact_depth(const PlacedScene& scene, double x, double y,
                                                double dx, double dy);

}  // namespace episcope::capture
