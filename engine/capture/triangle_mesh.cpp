// SPDX-License-Identifier: BSD-3-Clause
#include "engine/capture/triangle_mesh.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <unordered_map>
#include <vector>

namespace episcope::capture {
namespace {

constexpr int kMostTries = 12;
constexpr double kFacesOfCube = 2.5;  // that a cube on a smooth surface leaves

double area_of(const TriangleMesh& mesh) {
  double twice = 0;
  for (const Face& face : mesh.faces) {
    double a[3];
    double b[3];
    for (int i = 0; i < 3; ++i) {
      a[i] = static_cast<double>(mesh.vertices[face[1]][i]) - mesh.vertices[face[0]][i];
      b[i] = static_cast<double>(mesh.vertices[face[2]][i]) - mesh.vertices[face[0]][i];
    }
    const double area =
        std::hypot(a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]);
    if (std::isfinite(area)) twice += area;
  }
  return twice / 2;
}

Vertex low_corner(const TriangleMesh& mesh) {
  Vertex low;
  low.fill(std::numeric_limits<float>::infinity());
  for (const Vertex& vertex : mesh.vertices) {
    for (int i = 0; i < 3; ++i) low[i] = std::min(low[i], vertex[i]);
  }
  return low;
}

std::uint64_t cube_of(const Vertex& vertex, const Vertex& low, double side) {
  std::uint64_t cube = 0;
  for (int i = 0; i < 3; ++i) {
    constexpr double kMost = (1 << 21) - 1;
    const double at = std::clamp((static_cast<double>(vertex[i]) - low[i]) / side, 0.0, kMost);
    cube = cube << 21 | static_cast<std::uint64_t>(at);
  }
  return cube;
}

/// Begins with the smallest index, in the same sense.
Face rotated(Face face) {
  std::rotate(face.begin(), std::ranges::min_element(face), face.end());
  return face;
}

TriangleMesh clustered(const TriangleMesh& mesh, const Vertex& low, double side) {
  struct Cube {
    double sum[3]{};
    std::uint32_t count = 0;
  };
  std::unordered_map<std::uint64_t, std::uint32_t> index_of;
  std::vector<Cube> cubes;
  std::vector<std::uint32_t> cube_of_vertex;
  cube_of_vertex.reserve(mesh.vertices.size());
  for (const Vertex& vertex : mesh.vertices) {
    const auto next = static_cast<std::uint32_t>(cubes.size());
    const auto [found, is_new] = index_of.try_emplace(cube_of(vertex, low, side), next);
    if (is_new) cubes.emplace_back();
    Cube& cube = cubes[found->second];
    for (int i = 0; i < 3; ++i) cube.sum[i] += vertex[i];
    ++cube.count;
    cube_of_vertex.push_back(found->second);
  }
  TriangleMesh coarse;
  for (const Face& face : mesh.faces) {
    const Face merged{cube_of_vertex[face[0]], cube_of_vertex[face[1]], cube_of_vertex[face[2]]};
    const bool is_flat = merged[0] == merged[1] || merged[1] == merged[2] || merged[2] == merged[0];
    if (!is_flat) coarse.faces.push_back(rotated(merged));
  }
  std::ranges::sort(coarse.faces);
  coarse.faces.erase(std::unique(coarse.faces.begin(), coarse.faces.end()), coarse.faces.end());
  for (const Cube& cube : cubes) {
    Vertex& mean = coarse.vertices.emplace_back();
    for (int i = 0; i < 3; ++i) mean[i] = static_cast<float>(cube.sum[i] / cube.count);
  }
  return coarse;
}

}  // namespace

TriangleMesh cluster_vertices(const TriangleMesh& mesh, std::size_t most_faces) {
  if (mesh.faces.size() <= most_faces) return mesh;
  const double area = area_of(mesh);
  if (!(area > 0) || most_faces == 0) return {};
  const Vertex low = low_corner(mesh);
  double side = std::sqrt(kFacesOfCube * area / static_cast<double>(most_faces));
  TriangleMesh coarse = clustered(mesh, low, side);
  for (int i = 1; i < kMostTries && coarse.faces.size() > most_faces; ++i) {
    const double excess =
        static_cast<double>(coarse.faces.size()) / static_cast<double>(most_faces);
    side *= std::max(1.1, std::sqrt(excess));
    coarse = clustered(mesh, low, side);
  }
  return coarse;
}

}  // namespace episcope::capture
