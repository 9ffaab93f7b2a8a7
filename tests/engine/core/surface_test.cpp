// SPDX-License-Identifier: BSD-3-Clause
#include "engine/core/error.h"
#include "engine/core/point_cloud.h"
#include "tests/test_main.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace episcope::in_surface_test {

namespace {

PointCloud surface_of(const Image<float>& map, double jump_px, int step = 1,
                      ImageView<const std::uint8_t> valid = {}) {
  const Image<std::uint8_t> rgba(map.height(), map.width(), 4, 9);
  const DisparityView view{map, valid};
  PointCloud cloud = make_point_cloud(view, {}, rgba, {.step = step});
  join_to_surface(cloud, view, step, jump_px);
  return cloud;
}

/// Twice the area that triangles cover in the image; positive if all are seen from their front.
double covered(const PointCloud& cloud) {
  double sum = 0;
  for (const auto& [a, b, c] : cloud.triangles) {
    const auto& p = cloud.positions[a];
    const auto& q = cloud.positions[b];
    const auto& r = cloud.positions[c];
    sum += (q[0] - p[0]) * (r[1] - p[1]) - (r[0] - p[0]) * (q[1] - p[1]);
  }
  return sum;
}

}  // namespace

class SurfaceTest : public QObject {
  Q_OBJECT

 private slots:
  void plane_isCoveredOnce_facingTheViewer() {
    const PointCloud cloud = surface_of(Image<float>(5, 8, 1, 0.5f), 0.1);

    QCOMPARE(cloud.triangles.size(), std::size_t(2 * 4 * 7));
    QCOMPARE(covered(cloud), 2.0 * 4 * 7);
  }

  void jump_isCut_andASlopeIsNot() {
    Image<float> map(6, 10, 1, 0.0f);
    for (int y = 0; y < 6; ++y) {
      for (int x = 0; x < 10; ++x) map.at(y, x) = 0.09f * x + (x >= 5 ? 0.5f : 0);
    }

    const PointCloud cloud = surface_of(map, 0.1);

    QCOMPARE(cloud.triangles.size(), std::size_t(2 * 5 * 8));  // one column of 9 is missing
    for (const auto& triangle : cloud.triangles) {
      std::set<bool> sides;
      for (const std::uint32_t corner : triangle) sides.insert(cloud.pixels[corner].x >= 5);
      QCOMPARE(sides.size(), std::size_t(1));
    }
    QCOMPARE(surface_of(map, 0.7).triangles.size(), std::size_t(2 * 5 * 9));
  }

  void missingPoint_leavesATriangleOfItsCell() {
    Image<std::uint8_t> valid(2, 2, 1, 1);
    for (const PixelIndex missing : {PixelIndex{0, 0}, {0, 1}, {1, 0}, {1, 1}}) {
      valid.at(missing.y, missing.x) = 0;
      const PointCloud cloud = surface_of(Image<float>(2, 2, 1, 0.5f), 0.1, 1, valid);
      QCOMPARE(cloud.triangles.size(), std::size_t(1));
      QCOMPARE(covered(cloud), 1.0);
      valid.at(missing.y, missing.x) = 1;
    }
  }

  void coarserPoints_mayDifferByMore() {
    Image<float> map(9, 13, 1, 0.0f);
    for (int y = 0; y < 9; ++y) {
      for (int x = 0; x < 13; ++x) map.at(y, x) = 0.09f * x;
    }

    QCOMPARE(surface_of(map, 0.1, 4).triangles.size(), std::size_t(2 * 2 * 3));
  }

  void corner_isDividedAlongItsEdge() {
    Image<float> map(2, 2, 1, 0.0f);
    map.at(1, 1) = 5;

    const PointCloud cloud = surface_of(map, 0.1);

    QCOMPARE(cloud.triangles.size(), std::size_t(1));  // the three that lie together stay joined
    QCOMPARE(covered(cloud), 1.0);
  }

  void jumpOfNothing_isRefused() {
    QVERIFY_THROWS_EXCEPTION(InvalidInput, surface_of(Image<float>(2, 2, 1, 0.5f), 0));
  }
};

}  // namespace episcope::in_surface_test

EPISCOPE_TEST(surface_test, SurfaceTest)
#include "surface_test.moc"
