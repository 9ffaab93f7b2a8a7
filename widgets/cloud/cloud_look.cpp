// SPDX-License-Identifier: BSD-3-Clause
#include "widgets/cloud/cloud_look.h"

#include <cmath>

namespace episcope {
namespace {

using Vector = std::array<float, 3>;

constexpr float kAmbient = 0.25F;

Vector minus(const Vector& a, const Vector& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

// Normals of vertices: sums of face normals, weighted by area.
std::vector<Vector> normals_of(const PointCloud& cloud) {
  std::vector<Vector> normals(cloud.positions.size());
  for (const auto& [a, b, c] : cloud.triangles) {
    const Vector normal = cross(minus(cloud.positions[b], cloud.positions[a]),
                                minus(cloud.positions[c], cloud.positions[a]));
    for (const std::uint32_t corner : {a, b, c}) {
      for (int i = 0; i < 3; ++i) normals[corner][i] += normal[i];
    }
  }
  return normals;
}

// Lit from a little above the viewer, from both sides: scans may be turned inside out.
std::uint8_t light(const Vector& normal) {
  const float length = std::hypot(normal[0], normal[1], normal[2]);
  if (!(length > 0)) return 128;
  const float facing =
      std::abs(0.2F * normal[0] + 0.4F * normal[1] + 0.9F * normal[2]) / (1.005F * length);
  return static_cast<std::uint8_t>(235 * (kAmbient + (1 - kAmbient) * std::fmin(facing, 1.0F)));
}

}  // namespace

PointCloud make_mesh_cloud(std::span<const std::array<float, 3>> vertices,
                           std::span<const std::array<std::uint32_t, 3>> faces) {
  PointCloud cloud;
  cloud.is_metric = true;
  cloud.positions.reserve(vertices.size());
  for (const auto& [x, y, z] : vertices) cloud.positions.push_back({x, -y, -z});
  cloud.triangles.assign(faces.begin(), faces.end());
  cloud.colors.reserve(vertices.size());
  for (const Vector& normal : normals_of(cloud)) {
    const std::uint8_t grey = light(normal);
    cloud.colors.push_back({grey, grey, grey});
  }
  return cloud;
}

}  // namespace episcope
