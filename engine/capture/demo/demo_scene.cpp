// SPDX-License-Identifier: BSD-3-Clause
#include "engine/capture/demo/demo_scene.h"

#include "engine/capture/demo/scan_mesh.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <random>

namespace episcope::capture {
namespace {

constexpr double kMiddleDepth = 850;

double normal(std::mt19937& random) {
  double sum = -6;
  for (int i = 0; i < 12; ++i) sum += random() * 0x1p-32;
  return sum;
}

/// Small angles in degrees about x, y and z.
std::array<double, 9> turn(double about_x, double about_y, double about_z) {
  constexpr double degree = std::numbers::pi / 180;
  const double cx = std::cos(about_x * degree);
  const double sx = std::sin(about_x * degree);
  const double cy = std::cos(about_y * degree);
  const double sy = std::sin(about_y * degree);
  const double cz = std::cos(about_z * degree);
  const double sz = std::sin(about_z * degree);
  return {cz * cy,
          cz * sy * sx - sz * cx,
          cz * sy * cx + sz * sx,
          sz * cy,
          sz * sy * sx + cz * cx,
          sz * sy * cx - cz * sx,
          -sy,
          cy * sx,
          cy * cx};
}

}  // namespace

DemoRig demo_rig(const DemoOptions& options) {
  DemoRig rig;
  rig.grid = options.grid;
  rig.camera.width = options.width;
  rig.camera.height = options.height;
  rig.camera.focal_x = rig.camera.focal_y = options.width * 680.0 / 480;
  rig.camera.center_x = options.width / 2.0 + 4;
  rig.camera.center_y = options.height / 2.0 - 3;
  rig.camera.distortion = {-0.1, 0.01, 0, 0, 0};
  rig.pose.rotation = turn(2, -6, 1);
  rig.pose.translation = {5, -8, kMiddleDepth};
  std::mt19937 random(options.seed);
  const double millimetres = kMiddleDepth / rig.camera.focal_x;  // of a px, at the middle depth
  const ViewIndex middle = options.grid.center();
  for (int i = 0; i < options.grid.count(); ++i) {
    const ViewIndex view = options.grid.view_at(i);
    Exposure exposure;
    exposure.x = (view.u - middle.u) * rig.step + options.jitter_px * millimetres * normal(random);
    exposure.y = (view.v - middle.v) * rig.step + options.jitter_px * millimetres * normal(random);
    exposure.rotation = turn(0.05, -0.08, 0.4);
    exposure.gain = 1 + options.gain * normal(random);
    exposure.noise = options.noise;
    exposure.seed = options.seed * 1000 + static_cast<unsigned>(i);
    rig.exposures.push_back(exposure);
  }
  return rig;
}

PlanePoint photographed(const DemoRig& rig, const Exposure& exposure, const Point3& on_scan) {
  const Point3 p = rig.pose.apply(on_scan);
  const double x = p.x - exposure.x;
  const double y = p.y - exposure.y;
  const auto& r = exposure.rotation;  // its transpose turns the gantry's axes into the camera's
  const double z = r[2] * x + r[5] * y + r[8] * p.z;
  return pixel_of_ray(
      rig.camera, {(r[0] * x + r[3] * y + r[6] * p.z) / z, (r[1] * x + r[4] * y + r[7] * p.z) / z});
}

std::vector<PointPair> demo_picks(const DemoRig& rig, const TriangleMesh& mesh,
                                  const DemoOptions& options) {
  const ViewIndex middle = rig.grid.center();
  const Exposure& exposure =
      rig.exposures[static_cast<std::size_t>(middle.v) * rig.grid.u + middle.u];
  const PlacedMesh placed{&mesh, rig.pose};
  const PlacedScene scene = place({&placed, 1}, Progress(1));
  ViewCamera camera{{rig.camera.focal_x, options.width * 1.0, options.height * 1.0},
                    exposure.x,
                    exposure.y,
                    0,
                    0,
                    2 * options.height,
                    2 * options.width};
  const ViewSurface surface = ViewRaster(scene, 1).view(camera, Progress());
  std::mt19937 random(options.seed + 77);
  std::vector<PointPair> picks;
  for (const Vertex& mark : scan_landmarks()) {
    const Point3 on_scan{mark[0], mark[1], mark[2]};
    const Point3 p = rig.pose.apply(on_scan);
    const int x = static_cast<int>(
        std::lround(camera.pinhole.focal_px * (p.x - camera.x) / p.z + camera.pinhole.center_x));
    const int y = static_cast<int>(
        std::lround(camera.pinhole.focal_px * (p.y - camera.y) / p.z + camera.pinhole.center_y));
    if (x < 0 || y < 0 || x >= camera.width || y >= camera.height) continue;
    if (surface.inverse_depth.at(y, x) > 1.01 / p.z) continue;  // hidden
    const PlanePoint pixel = photographed(rig, exposure, on_scan);
    const bool is_inside = pixel.x > 30 && pixel.y > 30 && pixel.x < options.width - 30 &&
                           pixel.y < options.height - 30;
    if (!is_inside) continue;
    picks.push_back({fmt::format("p{}", picks.size() + 1),
                     pixel.x + options.pick_px * normal(random),
                     pixel.y + options.pick_px * normal(random), on_scan});
  }
  return picks;
}

}  // namespace episcope::capture
