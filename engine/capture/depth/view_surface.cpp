// SPDX-License-Identifier: BSD-3-Clause
#include "engine/capture/depth/view_surface.h"

#include "engine/capture/depth/depth_edges.h"
#include "engine/capture/depth/tile_raster.h"
#include "engine/core/error.h"
#include "engine/core/parallel/parallel.h"

#include <algorithm>
#include <limits>

namespace episcope::capture {
namespace {

constexpr std::size_t kChunk = 1 << 16;

int chunks_of(std::size_t count) {
  return static_cast<int>((count + kChunk - 1) / kChunk);
}

template <class Body>
void for_each_chunked(std::size_t count, const Progress& progress, const Body& body) {
  parallel_for(chunks_of(count), progress, [&](int chunk) {
    const std::size_t first = chunk * kChunk;
    for (std::size_t i = first; i < std::min(first + kChunk, count); ++i) body(i);
  });
}

ScreenVertex project(const Vertex& vertex, const ViewCamera& camera) {
  const double z = vertex[2];
  if (!(z > 0)) return {};
  const double w = 1 / z;
  const Pinhole& pinhole = camera.pinhole;
  const double x = pinhole.focal_px * (vertex[0] - camera.x) * w + pinhole.center_x;
  const double y = pinhole.focal_px * (vertex[1] - camera.y) * w + pinhole.center_y;
  return {static_cast<float>(x + camera.shift_x), static_cast<float>(y + camera.shift_y),
          static_cast<float>(w)};
}

ViewSurface blank(const ViewCamera& camera) {
  const int h = camera.height;
  const int w = camera.width;
  return {Image<std::uint32_t>(h, w, 1, PixelSurface::kNone), Image<float>(h, w),
          Image<float>(h, w), Image<float>(h, w), Image<std::uint8_t>(h, w)};
}

void put(int y, int x, const PixelSurface& surface, ViewSurface& view) {
  if (surface.triangle == PixelSurface::kNone) return;
  constexpr float whole = 1 - 1e-4F;
  const bool is_seen =
      surface.is_front && !surface.is_edge && surface.covered >= whole && surface.plane.at_zero > 0;
  view.triangle.at(y, x) = surface.triangle;
  view.inverse_depth.at(y, x) = static_cast<float>(surface.plane.at_zero);
  view.by_x.at(y, x) = static_cast<float>(surface.plane.by_x);
  view.by_y.at(y, x) = static_cast<float>(surface.plane.by_y);
  view.state.at(y, x) = is_seen ? ViewSurface::Seen : ViewSurface::Unsure;
}

}  // namespace

int PlacedScene::mesh_of(std::uint32_t face) const {
  return static_cast<int>(std::ranges::upper_bound(first_face, face) - first_face.begin()) - 1;
}

PlacedScene place(std::span<const PlacedMesh> meshes, const Progress& progress) {
  PlacedScene scene;
  std::size_t vertices = 0;
  std::size_t faces = 0;
  for (const PlacedMesh& placed : meshes) {
    vertices += placed.mesh->vertices.size();
    faces += placed.mesh->faces.size();
  }
  if (vertices >= PixelSurface::kNone || faces >= PixelSurface::kNone) {
    throw InvalidInput("the meshes have more than 4 billion vertices or faces; reduce them");
  }
  scene.vertices.resize(vertices);
  scene.faces.resize(faces);
  std::uint32_t first_vertex = 0;
  std::uint32_t first_face = 0;
  for (const auto& placed : meshes) {
    const TriangleMesh& mesh = *placed.mesh;
    scene.first_face.push_back(first_face);
    for_each_chunked(mesh.vertices.size(), progress, [&](std::size_t i) {
      const Vertex& v = mesh.vertices[i];
      const Point3 p = placed.pose.apply({v[0], v[1], v[2]});
      scene.vertices[first_vertex + i] = {static_cast<float>(p.x), static_cast<float>(p.y),
                                          static_cast<float>(p.z)};
    });
    for_each_chunked(mesh.faces.size(), progress, [&](std::size_t i) {
      for (int k = 0; k < 3; ++k) {
        scene.faces[first_face + i][k] = first_vertex + mesh.faces[i][k];
      }
    });
    first_vertex += static_cast<std::uint32_t>(mesh.vertices.size());
    first_face += static_cast<std::uint32_t>(mesh.faces.size());
  }
  return scene;
}

struct ViewRaster::State {
  const PlacedScene& scene;
  double jump;
  bool both_sides;
  std::vector<ScreenVertex> vertices{};
  TileBins bins{};
};

ViewRaster::ViewRaster(const PlacedScene& scene, double jump, bool both_sides)
    : state_(new State{scene, jump, both_sides}) {}
ViewRaster::~ViewRaster() = default;

ViewSurface ViewRaster::view(const ViewCamera& camera, const Progress& progress) {
  State& s = *state_;
  s.vertices.resize(s.scene.vertices.size());
  for_each_chunked(s.vertices.size(), progress.part(0, 0.1),
                   [&](std::size_t i) { s.vertices[i] = project(s.scene.vertices[i], camera); });
  s.bins.fill(s.scene.faces, s.vertices, camera.height, camera.width, s.both_sides,
              progress.part(0.1, 0.3));
  ViewSurface view = blank(camera);
  const RasterInput input{s.scene.faces, s.vertices, &s.bins,     camera.height,
                          camera.width,  s.jump,     s.both_sides};
  parallel_for_workers(s.bins.tile_count(), progress.part(0.3, 0.95), [&] {
    return [&, raster = TileRaster(input)](int tile) mutable {
      raster.run(tile,
                 [&](int y, int x, const PixelSurface& surface) { put(y, x, surface, view); });
    };
  });
  mark_cracks(view, s.jump, progress.part(0.95, 1));
  return view;
}

}  // namespace episcope::capture
