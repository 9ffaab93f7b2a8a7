// SPDX-License-Identifier: BSD-3-Clause
#include "engine/core/error.h"
#include "engine/core/point_cloud.h"
#include "tests/test_main.h"

#include <cmath>
#include <limits>

namespace episcope::in_point_cloud_test {

class PointCloudTest : public QObject {
  Q_OBJECT

 private slots:
  void invalidPixels_areLeftOut() {
    Image<float> map(2, 3, 1, 0.5f);
    map.at(0, 0) = std::numeric_limits<float>::quiet_NaN();
    Image<std::uint8_t> valid(2, 3, 1, 1);
    valid.at(1, 2) = 0;
    const Image<std::uint8_t> rgba(2, 3, 4, 9);

    const auto cloud = make_point_cloud({map, valid}, {}, rgba);

    QCOMPARE(cloud.positions.size(), std::size_t(4));
    QCOMPARE(cloud.colors.size(), std::size_t(4));
    QVERIFY(!cloud.is_metric);
  }

  void axes_areRightUpAndTowardsTheViewer() {
    Image<float> map(3, 3, 1, 0.0f);
    map.at(0, 2) = 1;  // Upper right, nearer.
    Image<std::uint8_t> rgba(3, 3, 4, 0);
    rgba.at(0, 2, 1) = 200;

    const auto cloud = make_point_cloud({map, {}}, {}, rgba);

    const auto& middle = cloud.positions[4];
    const auto& corner = cloud.positions[2];
    QCOMPARE(middle[0], 0.0f);
    QVERIFY(corner[0] > 0 && corner[1] > 0 && corner[2] > middle[2]);
    QCOMPARE(int(cloud.colors[2][1]), 200);
  }

  void knownCamera_givesDepthByEquation1() {
    const CameraGrid camera = camera_grid_from_blender({0.05, 0.7, 12, 40});
    Image<float> map(30, 40, 1, 0.25f);
    const Image<std::uint8_t> rgba(30, 40, 4, 9);

    const auto cloud = make_point_cloud({map, {}}, camera, rgba);

    const double depth = camera.depth_from_disparity(0.25);
    QVERIFY(cloud.is_metric);
    QVERIFY(std::abs(cloud.positions[0][2] + depth) < 1e-5 * depth);  // Float.
    // Over the whole image width one sees 2·Z·tan(fov/2), less one of 40 pixels.
    const double seen = cloud.positions[39][0] - cloud.positions[0][0];
    QVERIFY(std::abs(seen - 2 * depth * std::tan(0.35) * 39 / 40) < 1e-4 * depth);
  }

  void focalLengthInPixels_givesTheSameAsRelative() {
    CameraGrid relative = camera_grid_from_blender({0.05, 0.7, 12, 40});
    relative.focal_length *= 10;  // Long enough to be one in pixels as well.
    CameraGrid pixels = relative;
    pixels.focal_length *= 40;
    pixels.baseline /= 40;
    Image<float> map(30, 40, 1, 0.25f);
    const Image<std::uint8_t> rgba(30, 40, 4, 9);

    const auto a = make_point_cloud({map, {}}, relative, rgba);
    const auto b = make_point_cloud({map, {}}, pixels, rgba);

    QVERIFY(std::abs(a.positions[0][0] - b.positions[0][0]) <= 1e-5 * std::abs(a.positions[0][0]));
    QCOMPARE(a.positions[0][2], b.positions[0][2]);
  }

  void pinhole_placesItsCentreOnTheAxis() {
    CameraGrid camera = camera_grid_from_blender({0.05, 0.7, 12, 40});
    camera.pinhole = Pinhole{55, 10, 20};
    Image<float> map(30, 40, 1, 0.25f);
    const Image<std::uint8_t> rgba(30, 40, 4, 9);

    const auto cloud = make_point_cloud({map, {}}, camera, rgba);

    const auto& center = cloud.positions[20 * 40 + 10];
    QCOMPARE(center[0], 0.0f);
    QCOMPARE(center[1], 0.0f);
    const double right = cloud.positions[20 * 40 + 21][0];
    QVERIFY(std::abs(right - 11 * camera.depth_from_disparity(0.25) / 55) < 1e-4);
  }

  void depthWithoutACamera_isAChoice() {
    Image<float> map(2, 2, 1, 0.5f);
    const Image<std::uint8_t> rgba(2, 2, 4, 9);

    QCOMPARE(make_point_cloud({map, {}}, {}, rgba, {.z_per_px = 8}).positions[0][2], 4.0f);
  }

  void step_takesEveryNthPixel() {
    Image<float> map(9, 9, 1, 0.0f);
    const Image<std::uint8_t> rgba(9, 9, 4, 9);

    QCOMPARE(make_point_cloud({map, {}}, {}, rgba, {.step = 4}).positions.size(), std::size_t(9));
  }

  void robustBounds_forgiveAFewWildPoints() {
    PointCloud cloud;
    for (int i = 0; i < 1000; ++i)
      cloud.positions.push_back({float(i), float(-i), i % 2 ? 1.f : 2.f});
    cloud.positions.push_back({0, 0, -1e9f});

    const auto box = robust_bounds(cloud);

    QCOMPARE(box[4], 1.0);
    QCOMPARE(box[5], 2.0);
    QVERIFY(box[0] <= 10 && box[1] >= 989 && box[2] <= -989 && box[3] >= -10);
    QVERIFY(robust_bounds({}) == (std::array<double, 6>{}));
  }

  void wrongInput_isRefused() {
    Image<float> map(4, 4, 1, 0.0f);

    QVERIFY_THROWS_EXCEPTION(
        InvalidInput, (void)make_point_cloud({map, {}}, {}, Image<std::uint8_t>(4, 5, 4, 0)));
    QVERIFY_THROWS_EXCEPTION(
        InvalidInput,
        (void)make_point_cloud({map, {}}, {}, Image<std::uint8_t>(4, 4, 4, 0), {.step = 0}));
  }
};

}  // namespace episcope::in_point_cloud_test

EPISCOPE_TEST(point_cloud_test, PointCloudTest)
#include "point_cloud_test.moc"
