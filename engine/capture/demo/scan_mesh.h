// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/capture/mesh/triangle_mesh.h"

namespace episcope::capture {

/// A mesh as a scanner makes them, in mm: a rough head and a box before a wall, on a slanted table.
/// Its frame has x to the right, y downwards, z away from the viewer, its origin in the head.
/// `detail`: triangles along a side of each part; about 16·detail² faces.
[[nodiscard]] TriangleMesh scan_mesh(int detail);

/// The same with a patch of the head missing, as scans have them.
[[nodiscard]] TriangleMesh scan_mesh_with_hole(int detail);

/// Places on the scan that can be told in a picture: corners of the box, and of the wall's pattern.
[[nodiscard]] std::vector<Vertex> scan_landmarks();

}  // namespace episcope::capture
