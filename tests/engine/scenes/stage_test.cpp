// SPDX-License-Identifier: BSD-3-Clause
#include "engine/scenes/stage.h"
#include "tests/test_main.h"

#include <cmath>

namespace episcope::in_stage_test {

using namespace episcope::scenes;

namespace {

ViewCamera center_camera(const Stage& stage) {
  ViewCamera camera;
  camera.principal[0] = (stage.width - 1) / 2.0;
  camera.principal[1] = (stage.height - 1) / 2.0;
  camera.focal_px = stage.focal_px;
  return camera;
}

}  // namespace

class StageTest : public QObject {
  Q_OBJECT

 private slots:
  void depth_followsEquationOne() {
    const Stage stage = make_stage(512, 512);

    QCOMPARE(stage.depth(0), stage.zero_depth);
    QVERIFY(stage.depth(1) < stage.depth(0));
    const double d = stage.parallax / stage.depth(0.7) - stage.parallax / stage.zero_depth;
    QVERIFY(std::abs(d - 0.7) < 1e-12);
  }

  void card_coversItsPixels() {
    const Stage stage = make_stage(200, 100);
    const Primitive card = make_card(stage, {19.5, 29.5, 39.5, 34.5, 0.5});

    const Bounds bounds = bounds_in_view(card, center_camera(stage), 200, 100);

    // A pixel more on each side at most than the corners at 19.5 … 39.5 and 29.5 … 34.5 need.
    QVERIFY(bounds.x_begin >= 18 && bounds.x_begin <= 19);
    QVERIFY(bounds.x_end >= 40 && bounds.x_end <= 42);
    QVERIFY(bounds.y_begin >= 28 && bounds.y_begin <= 29);
    QVERIFY(bounds.y_end >= 35 && bounds.y_end <= 37);
  }

  void bounds_holdACurvedBelly() {
    const Stage stage = make_stage(512, 512);
    Primitive ball;
    ball.shape = Shape::Revolution;
    ball.center[2] = 10;
    ball.extent[0] = -1;
    ball.extent[1] = 1;
    ball.profile[0] = 1;
    ball.profile[2] = -1;

    const Bounds bounds = bounds_in_view(ball, center_camera(stage), 512, 512);

    const double radius_px = stage.focal_px / std::sqrt(99.0);  // Outline of a unit ball at Z = 10.
    QVERIFY(bounds.x_begin <= 255.5 - radius_px && bounds.x_end >= 255.5 + radius_px);
    QVERIFY(bounds.x_end - bounds.x_begin < 2.5 * radius_px);
  }

  void endlessPlane_mayBeAnywhere() {
    const Stage stage = make_stage(64, 48);

    const Bounds bounds =
        bounds_in_view(make_plane(stage, {0, 0.02, 0}), center_camera(stage), 64, 48);

    QCOMPARE(bounds.x_begin, 0);
    QCOMPARE(bounds.x_end, 64);
    QCOMPARE(bounds.y_begin, 0);
    QCOMPARE(bounds.y_end, 48);
  }
};

}  // namespace episcope::in_stage_test

EPISCOPE_TEST(stage_test, StageTest)
#include "stage_test.moc"
