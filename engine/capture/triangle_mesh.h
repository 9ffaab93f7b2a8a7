// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace episcope::capture {

/// A corner of triangles, in the unit and the frame of the scan.
using Vertex = std::array<float, 3>;

/// Indices of three vertices, counter-clockwise as seen from outside.
using Face = std::array<std::uint32_t, 3>;

/// A surface of triangles.
struct TriangleMesh {
  std::vector<Vertex> vertices;
  std::vector<Face> faces;
};

/// A coarser mesh of about `most_faces` at most: vertices in the same cube of a grid become one, at
/// their mean; of faces, those remain whose corners lie in three cubes, each once. The cubes are as
/// small as the count of faces allows. A mesh that is small enough comes back as it is. For meshes
/// to be looked at while they move. Linear but for the sorting of what remains.
/// Source: Rossignac and Borrel, Multi-resolution 3D approximations for rendering complex scenes,
/// 1993.
[[nodiscard]] TriangleMesh cluster_vertices(const TriangleMesh& mesh, std::size_t most_faces);

}  // namespace episcope::capture
