// SPDX-License-Identifier: BSD-3-Clause
#include "tests/engine/capture/exact_rays.h"

#include <array>

namespace episcope::capture {
namespace {

using Vector = std::array<double, 3>;

Vector minus(const Vertex& a, const Vertex& b) {
  return {static_cast<double>(a[0]) - b[0], static_cast<double>(a[1]) - b[1],
          static_cast<double>(a[2]) - b[2]};
}
Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
double dot(const Vector& a, const Vector& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

}  // namespace

std::optional<double> exact_depth(const PlacedScene& scene, double x, double y, double dx,
                                  double dy) {
  const Vector direction{dx, dy, 1};
  std::optional<double> nearest;
  for (const Face& face : scene.faces) {
    const Vertex& a = scene.vertices[face[0]];
    const Vector e1 = minus(scene.vertices[face[1]], a);
    const Vector e2 = minus(scene.vertices[face[2]], a);
    const Vector p = cross(direction, e2);
    const double determinant = dot(e1, p);
    if (determinant == 0) continue;
    const Vector from{x - a[0], y - a[1], -static_cast<double>(a[2])};
    const double u = dot(from, p) / determinant;
    if (u < 0 || u > 1) continue;
    const Vector q = cross(from, e1);
    const double v = dot(direction, q) / determinant;
    if (v < 0 || u + v > 1) continue;
    const double depth = dot(e2, q) / determinant;
    if (depth > 0 && (!nearest || depth < *nearest)) nearest = depth;
  }
  return nearest;
}

}  // namespace episcope::capture
