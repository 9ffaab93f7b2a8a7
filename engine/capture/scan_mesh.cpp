// SPDX-License-Identifier: BSD-3-Clause
#include "engine/capture/scan_mesh.h"

#include <array>
#include <cmath>
#include <numbers>

namespace episcope::capture {
namespace {

constexpr double kHead = 75;  // mm
constexpr Vertex kBox{105, 65, -40};
constexpr float kBoxSide = 38;  // half
constexpr float kBoxTurn = 0.45F;

/// Adds the surface place(s, t), s and t in [0, 1], of `steps` × `steps` quads; its outside is
/// where the place turns clockwise as s and t grow, in a frame with y downwards and z forwards.
template <class Place>
void add_surface(TriangleMesh& mesh, int steps, const Place& place) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  const auto across = static_cast<std::uint32_t>(steps + 1);
  for (int i = 0; i <= steps; ++i) {
    for (int k = 0; k <= steps; ++k) {
      mesh.vertices.push_back(
          place(static_cast<double>(k) / steps, static_cast<double>(i) / steps));
    }
  }
  for (std::uint32_t i = 0; i + 1 < across; ++i) {
    for (std::uint32_t k = 0; k + 1 < across; ++k) {
      const std::uint32_t a = first + i * across + k;
      mesh.faces.push_back({a, a + across, a + 1});
      mesh.faces.push_back({a + 1, a + across, a + across + 1});
    }
  }
}

Vertex vertex(double x, double y, double z) {
  return {static_cast<float>(x), static_cast<float>(y), static_cast<float>(z)};
}

/// A point of the head: a sphere with broad features and fine roughness.
Vertex head(double s, double t) {
  const double around = 2 * std::numbers::pi * (0.75 + s);
  const double down = std::numbers::pi * (0.002 + 0.996 * t);
  const double x = std::sin(down) * std::cos(around);
  const double y = -std::cos(down);
  const double z = std::sin(down) * std::sin(around);
  const Point3 direction{x, y, z};
  const double radius = kHead * (1 + 0.10 * solid_noise(direction, 0.6, 11) +
                                 0.012 * solid_noise(direction, 0.15, 12));
  return vertex(radius * x - 45, radius * y * 1.2, radius * z);
}

Vertex box_place(double x, double y, double z) {
  const double c = std::cos(kBoxTurn);
  const double s = std::sin(kBoxTurn);
  return vertex(kBox[0] + kBoxSide * (c * x + s * z), kBox[1] + kBoxSide * y,
                kBox[2] + kBoxSide * (-s * x + c * z));
}

void add_box(TriangleMesh& mesh, int steps) {
  add_surface(mesh, steps, [](double s, double t) { return box_place(2 * s - 1, 2 * t - 1, -1); });
  add_surface(mesh, steps, [](double s, double t) { return box_place(1 - 2 * s, 2 * t - 1, 1); });
  add_surface(mesh, steps, [](double s, double t) { return box_place(-1, 2 * t - 1, 1 - 2 * s); });
  add_surface(mesh, steps, [](double s, double t) { return box_place(1, 2 * t - 1, 2 * s - 1); });
  add_surface(mesh, steps, [](double s, double t) { return box_place(2 * s - 1, -1, 1 - 2 * t); });
  add_surface(mesh, steps, [](double s, double t) { return box_place(2 * s - 1, 1, 2 * t - 1); });
}

}  // namespace

TriangleMesh scan_mesh(int detail) {
  TriangleMesh mesh;
  add_surface(mesh, 2 * detail, head);
  add_box(mesh, detail / 2);
  add_surface(mesh, detail, [](double s, double t) {  // the wall
    return vertex(-480 + 960 * s, -420 + 560 * t, 170);
  });
  add_surface(mesh, detail, [](double s, double t) {  // the table
    return vertex(-480 + 960 * s, 60 + 200 * t, 200 - 330 * t);
  });
  return mesh;
}

TriangleMesh scan_mesh_with_hole(int detail) {
  TriangleMesh mesh = scan_mesh(detail);
  const Vertex middle = head(0.06, 0.55);
  std::erase_if(mesh.faces, [&](const Face& face) {
    double squares = 0;
    for (int k = 0; k < 3; ++k) {
      const double off = mesh.vertices[face[0]][k] - middle[k];
      squares += off * off;
    }
    return squares < 64;
  });
  return mesh;
}

std::vector<Vertex> scan_landmarks() {
  std::vector<Vertex> marks;
  for (const double y : {-1.0, 1.0}) {
    for (const double x : {-1.0, 1.0}) marks.push_back(box_place(x, y, -1));
  }
  marks.push_back(box_place(1, -1, 1));
  for (const double x : {-230.0, -110.0, 60.0, 240.0}) {
    for (const double y : {-170.0, -110.0}) marks.push_back(vertex(x, y, 170));
  }
  for (const auto& [s, t] : {std::array{0.02, 0.35}, {0.95, 0.4}, {0.05, 0.7}, {0.9, 0.6}}) {
    marks.push_back(head(s, t));
  }
  marks.push_back(vertex(-200, 60 + 200 * 0.4, 200 - 330 * 0.4));
  marks.push_back(vertex(40, 60 + 200 * 0.45, 200 - 330 * 0.45));
  marks.push_back(vertex(230, 60 + 200 * 0.4, 200 - 330 * 0.4));
  return marks;
}

}  // namespace episcope::capture
