// SPDX-License-Identifier: BSD-3-Clause
// Tools of single places, driven with the mouse on a canvas.
#include "tests/widgets/pictures.h"
#include "tests/window_test_main.h"
#include "widgets/canvas/canvas_tool.h"
#include "widgets/canvas/view_canvas.h"

#include <QSignalSpy>

namespace episcope::in_point_tools_test {

class PointToolsTest : public QObject {
  Q_OBJECT

 private slots:
  void init() {
    canvas_ = std::make_unique<ViewCanvas>();
    canvas_->resize(400, 300);
    canvas_->setPicture(test::coordinate_picture(80, 60));
    canvas_->setCanvasTransform({4, {40, 30}});
    canvas_->show();
    QVERIFY(QTest::qWaitForWindowExposed(canvas_.get()));
  }

  void click_picksAPointOnce() {
    PointTool tool;
    canvas_->setTool(&tool);
    const QSignalSpy points(&tool, &PointTool::pointPicked);
    const QSignalSpy cross_hair(canvas_.get(), &ViewCanvas::crossHairRequested);

    QTest::mousePress(canvas_.get(), Qt::LeftButton, {}, {204, 146});
    QTest::mouseMove(canvas_.get(), {240, 150});  // a drag picks nothing more
    QTest::mouseRelease(canvas_.get(), Qt::LeftButton, {}, {240, 150});
    canvas_->setTool(nullptr);

    QCOMPARE(points.size(), 1);
    QCOMPARE(points[0][0].toPointF(), QPointF(41, 29));
    QCOMPARE(cross_hair.size(), 0);
  }

  void buttonsAndShift_sayHowToFill() {
    FillTool tool;
    canvas_->setTool(&tool);
    const QSignalSpy fills(&tool, &FillTool::fillRequested);

    QTest::mouseClick(canvas_.get(), Qt::LeftButton, Qt::ShiftModifier, {200, 150});
    QTest::mouseClick(canvas_.get(), Qt::RightButton, {}, {200, 150});
    canvas_->setTool(nullptr);

    QCOMPARE(fills.size(), 2);
    const auto first = fills[0][0].value<StrokeStart>();
    const auto second = fills[1][0].value<StrokeStart>();
    QCOMPARE(first.at, QPointF(40, 30));
    QVERIFY(first.protects_others && !first.erases);
    QVERIFY(second.erases && !second.protects_others);
  }

  void drag_drawsARectangleOfWholePixels() {
    RectangleTool tool;
    canvas_->setTool(&tool);
    const QSignalSpy dragged(&tool, &RectangleTool::rectangleDragged);
    const QSignalSpy drawn(&tool, &RectangleTool::rectangleDrawn);
    const QSignalSpy cancelled(&tool, &RectangleTool::rectangleCancelled);

    QTest::mousePress(canvas_.get(), Qt::LeftButton, {}, {242, 170});  // pixel x 50, y 35
    QTest::mouseMove(canvas_.get(), {220, 160});
    QTest::mouseMove(canvas_.get(), {202, 150});
    QTest::mouseRelease(canvas_.get(), Qt::LeftButton, {}, {202, 150});
    QTest::mouseClick(canvas_.get(), Qt::LeftButton, {}, {202, 150});
    canvas_->setTool(nullptr);

    QCOMPARE(dragged.size(), 2);
    QCOMPARE(drawn.size(), 1);
    const auto rectangle = drawn[0][0].value<PixelRect>();
    QCOMPARE((std::vector{rectangle.y0, rectangle.x0, rectangle.y1, rectangle.x1}),
             (std::vector{30, 40, 35, 51}));
    QCOMPARE(cancelled.size(), 1);  // a click
  }

  void withoutTheTool_clicksMoveTheCrossHair() {
    PointTool tool;
    canvas_->setTool(&tool);
    canvas_->setTool(nullptr);
    const QSignalSpy points(&tool, &PointTool::pointPicked);
    const QSignalSpy cross_hair(canvas_.get(), &ViewCanvas::crossHairRequested);

    QTest::mouseClick(canvas_.get(), Qt::LeftButton, {}, {200, 150});

    QCOMPARE(points.size(), 0);
    QCOMPARE(cross_hair.size(), 1);
  }

 private:
  std::unique_ptr<ViewCanvas> canvas_;
};

}  // namespace episcope::in_point_tools_test

EPISCOPE_WINDOW_TEST(point_tools_test, PointToolsTest)
#include "point_tools_test.moc"
