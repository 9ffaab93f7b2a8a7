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

/// Simplifies a mesh to about `most_faces` at most, for display while it moves. Vertices within one
/// cube of a grid become their mean; faces with corners in three cubes remain, each once. Cubes are
/// as small as the number of faces allows. A small mesh is returned unchanged. Linear, except for
/// sorting the remaining faces. Source: Rossignac and Borrel, Multi-resolution 3D approximations
/// for rendering complex scenes, 1993.
[[nodiscard]] TriangleMesh cluster_vertices(const TriangleMesh& mesh, std::size_t most_faces);

}  // namespace episcope::capture
