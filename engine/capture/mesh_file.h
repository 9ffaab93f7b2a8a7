// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/capture/camera.h"
#include "engine/core/progress.h"

#include <array>
#include <cmath>
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

/// A mesh as a scanner makes them, in mm: a rough head and a box before a wall, on a slanted table.
/// Its frame has x to the right, y downwards, z away from the viewer, its origin in the head.
/// `detail`: triangles along a side of each part; about 16·detail² faces.
[[nodiscard]] TriangleMesh scan_mesh(int detail);

/// `scan_mesh` with a hole in the head, as real scans have.
[[nodiscard]] TriangleMesh scan_mesh_with_hole(int detail);

/// Places on the scan that are recognizable in a picture: corners of the box and of the wall's
/// pattern.
[[nodiscard]] std::vector<Vertex> scan_landmarks();

/// A value in [−1, 1] for every point of an integer lattice.
[[nodiscard]] inline double lattice_value(std::int64_t x, std::int64_t y, std::int64_t z,
                                          std::uint32_t seed) {
  std::uint32_t h = seed ^ (static_cast<std::uint32_t>(x) * 0x9E3779B1U);
  h ^= static_cast<std::uint32_t>(y) * 0x85EBCA77U;
  h ^= static_cast<std::uint32_t>(z) * 0xC2B2AE3DU;
  h = (h ^ (h >> 15)) * 0x2C1B3C6DU;
  h = (h ^ (h >> 12)) * 0x297A2D39U;
  h ^= h >> 15;
  return static_cast<double>(h >> 8) * 0x1p-23 - 1;
}

/// Value noise in space, with C2 interpolation of a lattice of that spacing.
[[nodiscard]] inline double solid_noise(const Point3& p, double spacing, std::uint32_t seed) {
  const double at[3] = {p.x / spacing, p.y / spacing, p.z / spacing};
  std::int64_t cell[3];
  double weight[3];
  for (int i = 0; i < 3; ++i) {
    const double whole = std::floor(at[i]);
    const double t = at[i] - whole;
    cell[i] = static_cast<std::int64_t>(whole);
    weight[i] = t * t * t * (t * (t * 6 - 15) + 10);
  }
  double sum = 0;
  for (int corner = 0; corner < 8; ++corner) {
    double share = 1;
    std::int64_t at_corner[3];
    for (int i = 0; i < 3; ++i) {
      const int side = corner >> i & 1;
      at_corner[i] = cell[i] + side;
      share *= side == 1 ? weight[i] : 1 - weight[i];
    }
    sum += share * lattice_value(at_corner[0], at_corner[1], at_corner[2], seed);
  }
  return sum;
}

}  // namespace episcope::capture
