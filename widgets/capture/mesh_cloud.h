// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/space/point_cloud.h"

#include <array>
#include <cstdint>
#include <span>

namespace episcope {

/// A surface for the 3D view, lit from the viewer: vertex i is position i, with y and z turned (a
/// mesh has y downwards and z forwards, like images). Faces are three indices of vertices. Linear.
[[nodiscard]] PointCloud make_mesh_cloud(std::span<const std::array<float, 3>> vertices,
                                         std::span<const std::array<std::uint32_t, 3>> faces);

}  // namespace episcope
