// SPDX-License-Identifier: BSD-3-Clause
#include "engine/core/camera_grid.h"
#include "engine/core/error.h"
#include "tests/test_main.h"

#include <cmath>
#include <limits>

namespace episcope::in_camera_grid_test {

namespace {

// tan(fov/2) = 0.36 to the digits that the angle is given with.
CameraGrid hand_made() {
  return camera_grid_from_blender({0.2, 2 * std::atan(0.36), 10, 768});
}

bool is_near(double a, double b, double tolerance) {
  return std::abs(a - b) <= tolerance;
}

}  // namespace

class CameraGridTest : public QObject {
  Q_OBJECT

 private slots:
  void blenderCamera_givesTheHandCheck() {
    const CameraGrid camera = hand_made();

    QVERIFY(is_near(camera.baseline, 153.6, 1e-12));
    QVERIFY(is_near(camera.focal_length, 1.38889, 5e-6));
    QVERIFY(is_near(camera.shift, 21.3333, 5e-5));
    QCOMPARE(camera.cam_distance.value(), 10.0);
  }

  void disparity_isThatOfTheHandCheck_data() {
    QTest::addColumn<double>("depth");
    QTest::addColumn<double>("disparity");
    QTest::newRow("nearer") << 8.0 << 5.3333;
    QTest::newRow("farther") << 12.0 << -3.5556;
    QTest::newRow("zero plane") << 10.0 << 0.0;
  }
  void disparity_isThatOfTheHandCheck() {
    QFETCH(double, depth);
    QFETCH(double, disparity);

    QVERIFY(is_near(hand_made().disparity_from_depth(depth), disparity, 5e-5));
  }

  void archiveFile_hasItsZeroPlaneAtTwenty() {
    // stillLife: dH 614.4, focalLength 9.375, shift 288.
    const CameraGrid camera{614.4, 9.375, 288, 20.0};

    QVERIFY(is_near(camera.disparity_from_depth(20), 0, 1e-12));
    QVERIFY(is_near(camera.depth_from_disparity(0), 20, 1e-12));
  }

  void depthAndDisparity_roundTrip() {
    const CameraGrid camera = hand_made();

    for (double depth = 0.5; depth < 1000; depth *= 1.3) {
      const double back = camera.depth_from_disparity(camera.disparity_from_depth(depth));
      QVERIFY(std::abs(back - depth) < 1e-6 * depth);
    }
  }

  void nearer_meansLargerDisparity() {
    const CameraGrid camera = hand_made();

    QVERIFY(camera.disparity_from_depth(9) > camera.disparity_from_depth(9.001));
  }

  void noSurface_hasNoDisparity_data() {
    QTest::addColumn<double>("depth");
    QTest::newRow("zero") << 0.0;
    QTest::newRow("negative") << -1.0;
    QTest::newRow("infinite") << std::numeric_limits<double>::infinity();
    QTest::newRow("NaN") << std::numeric_limits<double>::quiet_NaN();
  }
  void noSurface_hasNoDisparity() {
    QFETCH(double, depth);

    QVERIFY(std::isnan(hand_made().disparity_from_depth(depth)));
  }

  void beyondInfinity_hasNoDepth() {
    const CameraGrid camera = hand_made();

    QVERIFY(std::isnan(camera.depth_from_disparity(-camera.shift)));
    QVERIFY(std::isnan(camera.depth_from_disparity(-camera.shift - 1)));
    QVERIFY(camera.depth_from_disparity(-camera.shift + 1e-3) > 1e4);
  }

  void benchmarkCamera_obeysItsOwnFormula() {
    const BenchmarkCamera cfg{100, 35, 60, 8, 512};

    const CameraGrid camera = camera_grid_from_benchmark(cfg);

    // d = (β·F' / Z − β)/(F'·sensor) with β = baseline·focal·side and F' the focus distance in mm.
    const double beta = 60.0 * 100 * 512;
    for (const double depth : {6000.0, 8000.0, 11000.0}) {
      const double expected = (beta * 8000 / depth - beta) / (8000 * 35.0);
      QVERIFY(is_near(camera.disparity_from_depth(depth), expected, 1e-9));
    }
    QVERIFY(is_near(camera.depth_from_disparity(0), 8000, 1e-8));
  }

  void unknownCamera_saysSo() {
    QVERIFY(!CameraGrid{}.is_known());
    QVERIFY(hand_made().is_known());
  }

  void parameters_mustBePositive() {
    QVERIFY_THROWS_EXCEPTION(InvalidInput,
                             static_cast<void>(camera_grid_from_blender({0, 0.7, 10, 768})));
    QVERIFY_THROWS_EXCEPTION(InvalidInput,
                             static_cast<void>(camera_grid_from_blender({0.2, -0.7, 10, 768})));
    QVERIFY_THROWS_EXCEPTION(
        InvalidInput, static_cast<void>(camera_grid_from_blender({0.2, 0.7, std::nan(""), 768})));
    QVERIFY_THROWS_EXCEPTION(InvalidInput,
                             static_cast<void>(camera_grid_from_blender({0.2, 0.7, 10, 0})));
    QVERIFY_THROWS_EXCEPTION(InvalidInput,
                             static_cast<void>(camera_grid_from_benchmark({100, 0, 60, 8, 512})));
  }
};

}  // namespace episcope::in_camera_grid_test

EPISCOPE_TEST(camera_grid_test, CameraGridTest)
#include "camera_grid_test.moc"
