// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/progress.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
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

/// Reads a mesh: PLY (ascii or binary), OBJ or STL, all of its parts as one, polygons as triangles.
/// Throws IoError for a file that is damaged or of another kind, that has no faces, coordinates
/// that are not finite, faces of vertices that do not exist, or more than a 32-bit index counts;
/// Cancelled.
[[nodiscard]] TriangleMesh read_mesh(const std::filesystem::path& path, const Progress& progress);

/// Writes binary PLY. Atomic. Throws IoError.
void write_mesh(const std::filesystem::path& path, const TriangleMesh& mesh);

}  // namespace episcope::capture
