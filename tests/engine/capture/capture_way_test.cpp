// SPDX-License-Identifier: BSD-3-Clause
#include "engine/capture/calibrate/calibrate.h"
#include "engine/capture/calibrate/sharpness.h"
#include "engine/capture/demo/demo_folder.h"
#include "engine/capture/demo/pattern_photograph.h"
#include "engine/capture/demo/scan_mesh.h"
#include "engine/capture/depth/visible_depth.h"
#include "engine/capture/pose/solve_pose.h"
#include "engine/capture/rectify/rectify.h"

#include "tests/engine/capture/exact_rays.h"
#include "tests/test_main.h"

#include <algorithm>
#include <cmath>
#include <random>

namespace episcope::in_capture_way_test {

using namespace capture;

namespace {

/// From photographs to truth, once for all tests.
struct Way {
  DemoOptions options;
  DemoRig rig;
  TriangleMesh mesh;
  Calibration calibration;
  Rectified rectified;
  SolvedPose pose;
  DepthGrid cameras;
  GroundTruth truth;
};

Calibration calibrated(const DemoRig& rig) {
  std::vector<PatternPhotograph> photographs;
  for (const RigidPose& pose : pattern_poses(demo_pattern(), 620, 12)) {
    Exposure exposure;
    exposure.noise = 2;
    exposure.seed = 40 + static_cast<unsigned>(photographs.size());
    const Image<std::uint8_t> picture =
        pattern_photograph(demo_pattern(), pose, rig.camera, exposure);
    PatternPhotograph photograph;
    photograph.found = find_pattern(picture, demo_pattern());
    photograph.sharpness = sharpness(picture, photograph.found.pixels, 5);
    photographs.push_back(photograph);
  }
  return calibrate(photographs, rig.camera.height, rig.camera.width);
}

Way go() {
  Way way;
  way.options.grid = {5, 5};
  way.options.height = 300;
  way.options.width = 400;
  way.options.detail = 50;
  way.options.seed = 6;
  way.rig = demo_rig(way.options);
  way.mesh = scan_mesh(way.options.detail);
  way.calibration = calibrated(way.rig);
  const LightField photographs = demo_photographs(way.rig, way.mesh, Progress(2));
  way.rectified = rectify(photographs, way.calibration.camera, {way.rig.step, true}, Progress(2));
  std::vector<PointPair> pairs = demo_picks(way.rig, way.mesh, way.options);
  for (PointPair& pair : pairs) {
    const PlanePoint place =
        way.rectified.center_pixel(way.calibration.camera, {pair.x_px, pair.y_px});
    pair.x_px = place.x;
    pair.y_px = place.y;
  }
  const LightField& field = *way.rectified.light_field;
  way.pose = solve_pose(pairs, field.info().camera);
  way.cameras = {field.grid(), field.height(), field.width(), field.info().camera};
  const PlacedMesh placed{&way.mesh, way.pose.pose};
  way.truth = visible_depth({&placed, 1}, way.cameras, {}, Progress(2));
  return way;
}

const Way& way() {
  static const Way the_way = go();
  return the_way;
}

/// What the true camera sees at a pixel of the rectified centre view.
struct ExactPixel {
  const Way& way;
  PlacedScene scene;
  RectifyingMap map;
  Exposure exposure;

  explicit ExactPixel(const Way& of)
      : way(of),
        map(of.rectified.alignment, of.calibration.camera, of.rig.grid, of.rectified.crop,
            of.cameras.camera.shift) {
    const PlacedMesh placed{&of.mesh, of.rig.pose};
    scene = place({&placed, 1}, Progress(1));
    const ViewIndex middle = of.rig.grid.center();
    exposure = of.rig.exposures[static_cast<std::size_t>(middle.v) * of.rig.grid.u + middle.u];
  }

  /// Of the surface, in the frame of the gantry.
  [[nodiscard]] std::optional<Point3> point(double x, double y) const {
    const PlanePoint pixel = map.photograph(way.rig.grid.center(), x, y);
    const PlanePoint ray = ray_of_pixel(way.rig.camera, pixel);
    const auto& r = exposure.rotation;
    const double z = r[6] * ray.x + r[7] * ray.y + r[8];
    const double dx = (r[0] * ray.x + r[1] * ray.y + r[2]) / z;
    const double dy = (r[3] * ray.x + r[4] * ray.y + r[5]) / z;
    const auto depth = exact_depth(scene, exposure.x, exposure.y, dx, dy);
    if (!depth) return {};
    return Point3{exposure.x + dx * *depth, exposure.y + dy * *depth, *depth};
  }

  /// By how much the rectified picture of a point moves for a step of the gantry, halved from both
  /// sides: what a perfect method would measure.
  [[nodiscard]] double disparity(const Point3& p) const {
    double x[2];
    for (int side = 0; side < 2; ++side) {
      Exposure moved = exposure;
      moved.x += (side == 0 ? -1 : 1) * way.rig.step;
      const auto& r = moved.rotation;
      const double from_x = p.x - moved.x;
      const double from_y = p.y - moved.y;
      const double z = r[2] * from_x + r[5] * from_y + r[8] * p.z;
      const PlanePoint ray{(r[0] * from_x + r[3] * from_y + r[6] * p.z) / z,
                           (r[1] * from_x + r[4] * from_y + r[7] * p.z) / z};
      x[side] = map.rectified(way.rig.grid.center(), pixel_of_ray(way.rig.camera, ray)).x;
    }
    return (x[0] - x[1]) / 2 - way.cameras.camera.shift;
  }
};

}  // namespace

class CaptureWayTest : public QObject {
  Q_OBJECT

 private slots:
  void rows_areAligned() {
    QVERIFY(way().rectified.before.percentile_95 > 0.3);
    QVERIFY2(way().rectified.after.percentile_95 <= 0.1,
             qPrintable(QString::number(way().rectified.after.percentile_95)));
  }

  void gains_areMeasured() {
    const ViewIndex middle = way().rig.grid.center();
    const double own =
        way().rig.exposures[static_cast<std::size_t>(middle.v) * way().rig.grid.u + middle.u].gain;
    for (std::size_t i = 0; i < way().rectified.gains.size(); ++i) {
      QVERIFY(std::abs(way().rectified.gains[i] - way().rig.exposures[i].gain / own) < 0.01);
    }
  }

  void disparity_isThatOfTheScene() {
    const ExactPixel exact(way());
    const ViewIndex middle = way().rig.grid.center();
    const DisparityView map = way().truth.field.view(middle);
    std::mt19937 random(9);
    std::vector<double> errors;
    while (errors.size() < 800) {
      const int y = static_cast<int>(random() % static_cast<unsigned>(map.disparity.height));
      const int x = static_cast<int>(random() % static_cast<unsigned>(map.disparity.width));
      if (!map.is_valid(y, x)) continue;
      const auto point = exact.point(x, y);
      errors.push_back(point ? std::abs(map.disparity.at(y, x) - exact.disparity(*point)) : 99);
    }
    std::ranges::sort(errors);
    qInfo("|disparity − exact|: median %.4f, 99 %% %.4f px", errors[400], errors[792]);
    QVERIFY(errors[400] <= 0.01);
    QVERIFY(errors[792] <= 0.05);
  }

  void discontinuities_areMasked() {
    const ExactPixel exact(way());
    const ViewIndex middle = way().rig.grid.center();
    const DisparityView map = way().truth.field.view(middle);
    int jumps = 0;
    int missed = 0;
    for (int y = 5; y < map.disparity.height - 5; y += 9) {
      std::optional<Point3> last;
      for (int x = 5; x < map.disparity.width - 5; ++x) {
        const auto point = exact.point(x, y);
        const bool jumps_here =
            point && last && std::abs(exact.disparity(*point) - exact.disparity(*last)) > 0.5;
        last = point;
        if (!jumps_here) continue;
        ++jumps;
        missed += map.is_valid(y, x) && map.is_valid(y, x - 1) ? 1 : 0;
      }
    }
    qInfo("%d of %d discontinuities are not masked where they are", missed, jumps);
    QVERIFY(jumps > 30);
    QCOMPARE(missed, 0);
  }

  void poseAndDepthError_areAsTold() {
    QVERIFY(way().pose.reprojection_error_px < 0.9);
    QVERIFY(way().pose.delta_tz_px < 0.1);
  }
};

}  // namespace episcope::in_capture_way_test

EPISCOPE_TEST(capture_way_test, CaptureWayTest)
#include "capture_way_test.moc"
