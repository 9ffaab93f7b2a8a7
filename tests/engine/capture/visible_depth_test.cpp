// SPDX-License-Identifier: BSD-3-Clause
#include "engine/capture/mesh_file.h"
#include "engine/capture/pixel_surface.h"
#include "engine/capture/view_surface.h"
#include "engine/core/error.h"

#include "tests/engine/capture/exact_rays.h"
#include "tests/test_main.h"

#include <cmath>
#include <numbers>

namespace episcope::in_visible_depth_test {

using namespace capture;

namespace {

constexpr double kFocal = 300;
constexpr double kDistance = 500;
constexpr double kRadius = 100;

DepthGrid grid(GridShape views = {1, 1}, int height = 160, int width = 200) {
  DepthGrid result{views, height, width, {}};
  result.camera.baseline = 10;
  result.camera.focal_length = kFocal;
  result.camera.shift = 6;
  result.camera.pinhole = Pinhole{kFocal, width / 2.0 - 0.3, height / 2.0 + 0.2};
  return result;
}

/// A sphere around the origin; its vertices lie on it.
TriangleMesh sphere(int steps) {
  TriangleMesh mesh;
  const auto across = static_cast<std::uint32_t>(2 * steps);
  for (int i = 0; i <= steps; ++i) {
    for (std::uint32_t k = 0; k < across; ++k) {
      const double down = std::numbers::pi * (0.001 + 0.998 * i / steps);
      const double around = std::numbers::pi * k / steps;
      mesh.vertices.push_back({static_cast<float>(kRadius * std::sin(down) * std::cos(around)),
                               static_cast<float>(-kRadius * std::cos(down)),
                               static_cast<float>(kRadius * std::sin(down) * std::sin(around))});
    }
  }
  for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(steps); ++i) {
    for (std::uint32_t k = 0; k < across; ++k) {
      const std::uint32_t a = i * across + k;
      const std::uint32_t b = i * across + (k + 1) % across;
      mesh.faces.push_back({a, a + across, b});
      mesh.faces.push_back({b, a + across, b + across});
    }
  }
  return mesh;
}

TriangleMesh rectangle(float left, float top, float right, float bottom, float z, float slope) {
  TriangleMesh mesh;
  for (const float y : {top, bottom}) {
    for (const float x : {left, right}) mesh.vertices.push_back({x, y, z + slope * x});
  }
  mesh.faces = {{0, 2, 1}, {1, 2, 3}};
  return mesh;
}

RigidPose at(double z) {
  RigidPose pose;
  pose.translation = {0, 0, z};
  return pose;
}

double depth_of(const GroundTruth& truth, const DepthGrid& grid, ViewIndex view, int y, int x) {
  return grid.camera.depth_from_disparity(truth.field.disparity.view(view).at(y, x));
}

}  // namespace

class VisibleDepthTest : public QObject {
  Q_OBJECT

 private slots:
  void sphere_isExactAwayFromItsSilhouette_inEveryView() {
    const TriangleMesh mesh = sphere(400);
    const PlacedMesh placed{&mesh, at(kDistance)};
    const DepthGrid cameras = grid({3, 3});
    const GroundTruth truth = visible_depth({&placed, 1}, cameras, {}, Progress(2));
    int inside = 0;
    for (int index = 0; index < 9; ++index) {
      const ViewIndex view = cameras.grid.view_at(index);
      const ViewCamera camera = view_camera(cameras, view);
      for (int y = 0; y < cameras.height; ++y) {
        for (int x = 0; x < cameras.width; ++x) {
          const double dx = (x - camera.shift_x - camera.pinhole.center_x) / kFocal;
          const double dy = (y - camera.shift_y - camera.pinhole.center_y) / kFocal;
          const double a = dx * dx + dy * dy + 1;
          const double b = -camera.x * dx - camera.y * dy + kDistance;
          const double c =
              camera.x * camera.x + camera.y * camera.y + kDistance * kDistance - kRadius * kRadius;
          const double root = b * b - a * c;
          if (root < 0.16 * kRadius * kRadius)
            continue;  // near the silhouette, or beside the sphere
          ++inside;
          QVERIFY(truth.field.valid.view(view).at(y, x) == 1);
          const double exact = (b - std::sqrt(root)) / a;
          const double depth = depth_of(truth, cameras, view, y, x);
          // Facets lie up to (π/800)²/2·R = 8e-4 mm inside of the sphere: 2e-6 of the depth.
          QVERIFY2(std::abs(depth - exact) < 1e-4 * exact,
                   qPrintable(QString("%1 instead of %2").arg(depth).arg(exact)));
          QCOMPARE(truth.labels.view(view).at(y, x), 1);
        }
      }
    }
    QVERIFY2(inside > 9 * 3000, qPrintable(QString::number(inside)));
  }

  void slantedPlane_isExact_andWhole() {
    const TriangleMesh mesh = rectangle(-900, -900, 900, 900, 600, 0.4F);
    const PlacedMesh placed{&mesh, {}};
    const DepthGrid cameras = grid({3, 3});
    const GroundTruth truth = visible_depth({&placed, 1}, cameras, {}, Progress(2));
    for (int index = 0; index < 9; ++index) {
      const ViewIndex view = cameras.grid.view_at(index);
      const ViewCamera camera = view_camera(cameras, view);
      for (int y = 0; y < cameras.height; ++y) {
        for (int x = 0; x < cameras.width; ++x) {
          const double dx = (x - camera.shift_x - camera.pinhole.center_x) / kFocal;
          const double exact = (600 + 0.4 * camera.x) / (1 - 0.4 * dx);
          QVERIFY(truth.field.valid.view(view).at(y, x) == 1);
          QVERIFY(std::abs(depth_of(truth, cameras, view, y, x) - exact) < 1e-5 * exact);
        }
      }
    }
  }

  void discontinuities_areAllMasked_atMostTwoPixelsWide() {
    // The edge of the front plane moves over pixels in steps of a tenth of a px.
    const TriangleMesh back = rectangle(-900, -900, 900, 900, 800, 0);
    const DepthGrid cameras = grid();
    for (int tenth = 0; tenth < 10; ++tenth) {
      const double edge_px = 90 + 0.1 * tenth;
      const auto edge =
          static_cast<float>((edge_px - cameras.camera.pinhole->center_x) * 500 / kFocal);
      const TriangleMesh front = rectangle(-900, -900, edge, 900, 500, 0);
      const std::vector<PlacedMesh> placed{{&back, {}}, {&front, {}}};
      const GroundTruth truth = visible_depth(placed, cameras, {}, Progress(1));
      int masked = 0;
      for (int x = 0; x < cameras.width; ++x) {
        const bool is_valid = truth.field.valid.view({0, 0}).at(70, x) == 1;
        masked += is_valid ? 0 : 1;
        const bool is_cut = std::abs(x - edge_px) < 0.5 - 1e-3;
        QVERIFY(!is_cut || !is_valid);
        if (!is_valid) continue;
        QCOMPARE(truth.labels.view({0, 0}).at(70, x), x < edge_px ? 2 : 1);
      }
      QVERIFY2(masked >= 1 && masked <= 2, qPrintable(QString::number(masked)));
    }
  }

  void discontinuities_ofAnyDirection_areMasked() {
    // The front is a half-plane whose edge runs through the picture at every 15 degrees.
    const TriangleMesh back = rectangle(-900, -900, 900, 900, 800, 0);
    const DepthGrid cameras = grid();
    const Pinhole& pinhole = *cameras.camera.pinhole;
    for (int degrees = 0; degrees < 360; degrees += 15) {
      const double across = degrees * std::numbers::pi / 180;
      const double nx = std::cos(across), ny = std::sin(across);
      TriangleMesh front = rectangle(-900, -900, 3.7F, 900, 500, 0);
      for (Vertex& v : front.vertices) {
        v = {static_cast<float>(nx * v[0] - ny * v[1]), static_cast<float>(ny * v[0] + nx * v[1]),
             v[2]};
      }
      const std::vector<PlacedMesh> placed{{&back, {}}, {&front, {}}};
      const GroundTruth truth = visible_depth(placed, cameras, {}, Progress(1));
      for (int y = 0; y < cameras.height; ++y) {
        for (int x = 0; x < cameras.width; ++x) {
          const double off =
              nx * (x - pinhole.center_x) + ny * (y - pinhole.center_y) - 3.7 * kFocal / 500;
          const bool is_valid = truth.field.valid.view({0, 0}).at(y, x) == 1;
          // A pixel reaches that far across the edge; a corner of 1e-4 px² counts as none, which is
          // at most sqrt(2e-4 · 0.5) px deep.
          const double reach = (std::abs(nx) + std::abs(ny)) / 2;
          QVERIFY(!is_valid || std::abs(off) > reach - 0.011);
          QVERIFY(is_valid || std::abs(off) < 1);
          if (is_valid) QCOMPARE(truth.labels.view({0, 0}).at(y, x), off < 0 ? 2 : 1);
        }
      }
    }
  }

  void holes_showNothing() {
    // Through the hole of a closed surface its inside is seen: no truth there.
    TriangleMesh mesh = sphere(60);
    std::erase_if(mesh.faces, [&](const Face& face) {
      const Vertex& v = mesh.vertices[face[0]];
      return v[2] < 0 && std::hypot(v[0], v[1]) < 25;
    });
    const PlacedMesh placed{&mesh, at(kDistance)};
    const DepthGrid cameras = grid();
    const GroundTruth truth = visible_depth({&placed, 1}, cameras, {}, Progress(1));
    QCOMPARE(truth.field.valid.view({0, 0}).at(80, 100), std::uint8_t{0});
    QCOMPARE(truth.field.valid.view({0, 0}).at(80, 100 + 35), std::uint8_t{1});
  }

  void threads_doNotMatter() {
    const TriangleMesh mesh = scan_mesh(40);
    const PlacedMesh placed{&mesh, at(850)};
    DepthGrid cameras = grid({1, 2}, 150, 200);
    cameras.camera.focal_length = cameras.camera.pinhole->focal_px = 280;
    const GroundTruth one = visible_depth({&placed, 1}, cameras, {}, Progress(1));
    const GroundTruth three = visible_depth({&placed, 1}, cameras, {}, Progress(3));
    const std::size_t count = one.field.disparity.size();
    QVERIFY(std::equal(one.field.disparity.data(), one.field.disparity.data() + count,
                       three.field.disparity.data()));
    QVERIFY(std::equal(one.field.valid.data(), one.field.valid.data() + count,
                       three.field.valid.data()));
  }

  void aScan_isAsRaysFindIt() {
    const TriangleMesh mesh = scan_mesh(40);
    const PlacedMesh placed{&mesh, at(850)};
    DepthGrid cameras = grid({1, 1}, 150, 200);
    cameras.camera.focal_length = cameras.camera.pinhole->focal_px = 280;
    const Pinhole& pinhole = *cameras.camera.pinhole;
    const GroundTruth truth = visible_depth({&placed, 1}, cameras, {}, Progress(2));
    const PlacedScene scene = place({&placed, 1}, Progress(1));
    int compared = 0;
    for (int y = 0; y < cameras.height; y += 3) {
      for (int x = 0; x < cameras.width; x += 3) {
        if (truth.field.valid.view({0, 0}).at(y, x) == 0) continue;
        const auto exact = exact_depth(scene, 0, 0, (x - pinhole.center_x) / pinhole.focal_px,
                                       (y - pinhole.center_y) / pinhole.focal_px);
        QVERIFY(exact.has_value());
        const double d = cameras.camera.disparity_from_depth(*exact);
        // Where the triangle at the center is not the largest, its neighbor's plane continues it.
        QVERIFY(std::abs(truth.field.disparity.view({0, 0}).at(y, x) - d) < 0.1);
        ++compared;
      }
    }
    QVERIFY(compared > 2800);
  }

  void wrongInput_isExplained() {
    const TriangleMesh mesh = sphere(20);
    PlacedMesh placed{&mesh, at(-500)};
    const auto message = [&](const DepthGrid& cameras) -> QString {
      try {
        (void)visible_depth({&placed, 1}, cameras, {}, Progress(1));
      } catch (const InvalidInput& error) {
        return QString::fromUtf8(error.what());
      }
      return {};
    };
    QVERIFY(message(grid()).contains("not in the picture"));
    placed.pose = at(500);
    DepthGrid unknown = grid();
    unknown.camera.pinhole.reset();
    QVERIFY(message(unknown).contains("pinhole"));
    TriangleMesh inverted = mesh;
    for (Face& face : inverted.faces) std::swap(face[0], face[1]);
    placed.mesh = &inverted;
    QVERIFY(message(grid()).contains("from inside"));
  }
};

}  // namespace episcope::in_visible_depth_test

EPISCOPE_TEST(visible_depth_test, VisibleDepthTest)
#include "visible_depth_test.moc"
