// SPDX-License-Identifier: BSD-3-Clause
#include "tests/test_main.h"
#include "widgets/canvas/canvas_geometry.h"

namespace episcope::in_canvas_transform_test {

namespace {

constexpr double kRounding = 1e-9;  // Coordinates below 1000 in double.

bool is_near(QPointF a, QPointF b) {
  return (a - b).manhattanLength() < kRounding;
}

}  // namespace

class CanvasTransformTest : public QObject {
  Q_OBJECT

 private slots:
  void mapping_isInvertedByItsInverse() {
    const CanvasTransform transform{3.25, {40.5, 17}};
    const QSizeF widget(401, 300);

    const QPointF there = transform.to_widget({12.25, 60}, widget);

    QVERIFY(is_near(transform.to_image(there, widget), {12.25, 60}));
  }

  void center_isShownInTheMiddle() {
    const CanvasTransform transform{7, {5, 6}};

    QVERIFY(is_near(transform.to_widget({5, 6}, {200, 100}), {100, 50}));
  }

  void zoomed_keepsTheAnchor_data() {
    QTest::addColumn<double>("factor");
    QTest::newRow("in") << 1.25;
    QTest::newRow("out") << 0.5;
    QTest::newRow("beyond the upper limit") << 1e6;
    QTest::newRow("beyond the lower limit") << 1e-6;
  }

  void zoomed_keepsTheAnchor() {
    QFETCH(double, factor);
    const CanvasTransform transform{2, {30, 40}};
    const QSizeF widget(400, 300);
    const QPointF anchor(371, 22);
    const QPointF before = transform.to_image(anchor, widget);

    const CanvasTransform zoomed = transform.zoomed(factor, anchor, widget);

    QVERIFY(is_near(zoomed.to_image(anchor, widget), before));
    QVERIFY(zoomed.scale >= kMinCanvasScale && zoomed.scale <= kMaxCanvasScale);
  }

  void panned_movesThePictureWithTheHand() {
    const CanvasTransform transform{4, {30, 40}};
    const QSizeF widget(400, 300);
    const QPointF before = transform.to_widget({10, 10}, widget);

    const CanvasTransform panned = transform.panned({8, -20});

    QVERIFY(is_near(panned.to_widget({10, 10}, widget), before + QPointF(8, -20)));
  }

  void fit_showsTheWholeImage_data() {
    QTest::addColumn<QSizeF>("image");
    QTest::newRow("wide") << QSizeF(900, 100);
    QTest::newRow("tall") << QSizeF(10, 77);
    QTest::newRow("square") << QSizeF(512, 512);
  }

  void fit_showsTheWholeImage() {
    QFETCH(QSizeF, image);
    const QSizeF widget(400, 300);

    const CanvasTransform fitted = fit_transform(image, widget);

    const QPointF top_left = fitted.to_widget({0, 0}, widget);
    const QPointF bottom_right = fitted.to_widget({image.width(), image.height()}, widget);
    QVERIFY(top_left.x() > 0 && top_left.y() > 0);
    QVERIFY(bottom_right.x() < 400 && bottom_right.y() < 300);
    // One of the two directions is filled up to the margin.
    QVERIFY(top_left.x() < 4.01 || top_left.y() < 4.01);
  }
};

}  // namespace episcope::in_canvas_transform_test

EPISCOPE_TEST(canvas_transform_test, CanvasTransformTest)
#include "canvas_transform_test.moc"
