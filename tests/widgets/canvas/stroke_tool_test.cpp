// SPDX-License-Identifier: BSD-3-Clause
// The brush and the eraser, driven with the mouse on a canvas.
#include "tests/window_test_main.h"
#include "widgets/canvas/canvas_tool.h"

#include "tests/widgets/pictures.h"
#include "widgets/canvas/canvas_geometry.h"
#include "widgets/canvas/view_canvas.h"

#include <QPainter>
#include <QPointingDevice>
#include <QSignalSpy>
#include <QTabletEvent>

#include <algorithm>
#include <cmath>
#include <memory>

namespace episcope::in_stroke_tool_test {

class StrokeToolTest : public QObject {
  Q_OBJECT

 private slots:
  void init() {
    canvas_ = std::make_unique<ViewCanvas>();
    canvas_->resize(400, 300);
    canvas_->setPicture(test::coordinate_picture(80, 60));
    tool_ = std::make_unique<StrokeTool>();
    canvas_->setTool(tool_.get());
    canvas_->show();
    QVERIFY(QTest::qWaitForWindowExposed(canvas_.get()));
  }
  void cleanup() {
    canvas_.reset();
    tool_.reset();
  }

  void ring_isAsLargeAsTheBrush_data() {
    QTest::addColumn<double>("scale");
    QTest::addColumn<double>("size");
    QTest::newRow("small picture") << 0.5 << 60.0;
    QTest::newRow("as it is") << 1.0 << 33.0;
    QTest::newRow("large") << 4.0 << 25.0;
    QTest::newRow("pixels") << 40.0 << 3.0;
  }

  void ring_isAsLargeAsTheBrush() {
    QFETCH(double, scale);
    QFETCH(double, size);
    QImage plate(600, 600, QImage::Format_RGB32);
    plate.fill(Qt::gray);
    tool_->setBrushSize(size);

    QPainter painter(&plate);
    tool_->paintMark(painter, {300, 300}, scale);
    painter.end();

    // The white line lies on the circle, to the right, left, above and below.
    const double radius = size * scale / 2;
    for (const QPointF& way : {QPointF(1, 0), QPointF(-1, 0), QPointF(0, 1), QPointF(0, -1)}) {
      double brightest = 0;
      int place = 0;
      for (int r = 6; r < 290; ++r) {
        const QPointF at = QPointF(300, 300) + way * r;
        const QColor color = plate.pixelColor(at.toPoint());
        if (color.lightnessF() > brightest + 0.05) {
          brightest = color.lightnessF();
          place = r;
        }
      }
      QVERIFY2(std::abs(place - radius) <= 1.5, qPrintable(QString::number(place)));
    }
  }

  // What lies outside its rectangle stays on the screen when the cursor moves on.
  void mark_liesWithinItsRectangle() {
    constexpr QPointF center(150.3, 149.6);
    tool_->setColor(Qt::green);
    for (double scale = 0.2; scale < 40; scale *= 1.15) {
      QImage plate(300, 300, QImage::Format_ARGB32_Premultiplied);
      plate.fill(Qt::transparent);
      tool_->setBrushSize(std::max(1.0, std::round(8 / scale)));

      QPainter painter(&plate);
      tool_->paintMark(painter, center, scale);
      painter.setCompositionMode(QPainter::CompositionMode_Clear);
      painter.fillRect(tool_->markRect(center, scale).toAlignedRect(), Qt::transparent);
      painter.end();

      QVERIFY2(test::color_count(plate) == 1, qPrintable(QString::number(scale)));
    }
  }

  void drag_isAStrokeInImageCoordinates() {
    canvas_->setCanvasTransform({4, {40, 30}});
    QSignalSpy starts(tool_.get(), &StrokeTool::strokeStarted);
    QSignalSpy points(tool_.get(), &StrokeTool::strokeExtended);
    QSignalSpy ends(tool_.get(), &StrokeTool::strokeFinished);

    QTest::mousePress(canvas_.get(), Qt::LeftButton, {}, {200, 150});
    QTest::mouseMove(canvas_.get(), {220, 150});
    QTest::mouseRelease(canvas_.get(), Qt::LeftButton, {}, {220, 150});

    QCOMPARE(starts.size(), 1);
    QCOMPARE(starts[0][0].value<StrokeStart>().at, QPointF(40, 30));
    QVERIFY(!starts[0][0].value<StrokeStart>().erases);
    QCOMPARE(points.size(), 1);
    QCOMPARE(points[0][0].toPointF(), QPointF(45, 30));
    QCOMPARE(ends.size(), 1);
  }

  void buttonsAndShift_chooseTheInk() {
    QSignalSpy starts(tool_.get(), &StrokeTool::strokeStarted);
    QTest::mouseClick(canvas_.get(), Qt::RightButton, {}, {200, 150});
    QTest::mouseClick(canvas_.get(), Qt::LeftButton, Qt::ShiftModifier, {200, 150});
    tool_->setErasing(true);
    QTest::mouseClick(canvas_.get(), Qt::LeftButton, {}, {200, 150});

    QCOMPARE(starts.size(), 3);
    QVERIFY(starts[0][0].value<StrokeStart>().erases);
    QVERIFY(!starts[1][0].value<StrokeStart>().erases);
    QVERIFY(starts[1][0].value<StrokeStart>().protects_others);
    QVERIFY(starts[2][0].value<StrokeStart>().erases);
  }

  void doubleClick_isTwoDabs() {
    QSignalSpy starts(tool_.get(), &StrokeTool::strokeStarted);
    QSignalSpy centers(canvas_.get(), &ViewCanvas::centerRequested);

    QTest::mouseClick(canvas_.get(), Qt::LeftButton, {}, {200, 150});
    QTest::mouseDClick(canvas_.get(), Qt::LeftButton, {}, {200, 150});
    QTest::mouseRelease(canvas_.get(), Qt::LeftButton, {}, {200, 150});

    QVERIFY(starts.size() >= 2);
    QCOMPARE(centers.size(), 0);
    QVERIFY(!tool_->isStroking());
  }

  void controlClick_movesTheCrossHair() {
    QSignalSpy starts(tool_.get(), &StrokeTool::strokeStarted);
    QSignalSpy clicks(canvas_.get(), &ViewCanvas::crossHairRequested);

    QTest::mouseClick(canvas_.get(), Qt::LeftButton, Qt::ControlModifier, {200, 150});

    QCOMPARE(starts.size(), 0);
    QCOMPARE(clicks.size(), 1);
  }

  void spaceAndMiddle_pan() {
    QSignalSpy starts(tool_.get(), &StrokeTool::strokeStarted);
    const QPointF before = canvas_->canvasTransform().center;
    QTest::keyPress(canvas_.get(), Qt::Key_Space);
    QTest::mousePress(canvas_.get(), Qt::LeftButton, {}, {200, 150});
    QTest::mouseMove(canvas_.get(), {230, 150});
    QTest::mouseRelease(canvas_.get(), Qt::LeftButton, {}, {230, 150});
    QTest::keyRelease(canvas_.get(), Qt::Key_Space);

    QCOMPARE(starts.size(), 0);
    QVERIFY(canvas_->canvasTransform().center != before);
  }

  void takenTool_endsTheStroke() {
    QSignalSpy ends(tool_.get(), &StrokeTool::strokeFinished);
    QTest::mousePress(canvas_.get(), Qt::LeftButton, {}, {200, 150});

    canvas_->setTool(nullptr);
    QCOMPARE(ends.size(), 1);
    QTest::mouseRelease(canvas_.get(), Qt::LeftButton, {}, {210, 150});
    QCOMPARE(ends.size(), 1);
  }

  void pen_drawsBetweenPixelsAndItsOtherEndErases() {
    QSignalSpy starts(tool_.get(), &StrokeTool::strokeStarted);
    QSignalSpy points(tool_.get(), &StrokeTool::strokeExtended);
    canvas_->setCanvasTransform({4, {40, 30}});

    pen(QEvent::TabletPress, {200.5, 150.25}, QPointingDevice::PointerType::Pen);
    pen(QEvent::TabletMove, {201.5, 150.25}, QPointingDevice::PointerType::Pen);
    pen(QEvent::TabletRelease, {201.5, 150.25}, QPointingDevice::PointerType::Pen);
    pen(QEvent::TabletPress, {200, 150}, QPointingDevice::PointerType::Eraser);
    pen(QEvent::TabletRelease, {200, 150}, QPointingDevice::PointerType::Eraser);

    QCOMPARE(starts.size(), 2);
    QCOMPARE(starts[0][0].value<StrokeStart>().at, QPointF(40.125, 30.0625));
    QCOMPARE(points.size(), 1);
    QVERIFY(starts[1][0].value<StrokeStart>().erases);
  }

  void patch_redrawsNoMoreThanItself() {
    QImage scribbles(80, 60, QImage::Format_ARGB32_Premultiplied);
    scribbles.fill(Qt::transparent);
    canvas_->setScribbles(scribbles);
    canvas_->setScribbleOpacity(1);
    canvas_->setCanvasTransform({4, {40, 30}});
    (void)canvas_->grab();
    QImage patch(4, 4, QImage::Format_ARGB32_Premultiplied);
    patch.fill(Qt::red);
    struct Watch : QObject {
      QRegion region;
      bool eventFilter(QObject*, QEvent* event) override {
        if (event->type() == QEvent::Paint) region += static_cast<QPaintEvent*>(event)->region();
        return false;
      }
    } watch;
    QCoreApplication::processEvents();
    canvas_->installEventFilter(&watch);

    canvas_->patchScribbles({40, 30}, patch);
    QTRY_VERIFY(!watch.region.isEmpty());

    QVERIFY(watch.region.boundingRect().width() <= 32);
    QCOMPARE(canvas_->scribbles().pixelColor(41, 31), QColor(Qt::red));
    QCOMPARE(canvas_->grab().toImage().pixelColor(208, 158), QColor(Qt::red));
    QCOMPARE(canvas_->scribbles().pixelColor(39, 31).alpha(), 0);
  }

  void carriedLabels_areFainterAndUnderPaintedOnes() {
    LabelSet labels;
    labels.add("a", Rgb{255, 0, 0});
    labels.add("b", Rgb{0, 0, 255});
    Image<std::uint8_t> painted(4, 10);
    Image<std::uint8_t> carried(4, 10, 1, 2);
    painted.at(1, 3) = 1;

    const QImage picture = scribble_picture({painted.view(), carried.view()}, labels, {1, 2, 3, 9});

    QCOMPARE(picture.size(), QSize(7, 2));
    QCOMPARE(picture.pixelColor(1, 0), QColor(255, 0, 0));
    for (int x = 2; x < 7; ++x) {
      QVERIFY(picture.pixelColor(x, 0).alpha() < 255);
      QVERIFY(picture.pixelColor(x, 0).alpha() > 0);
      QVERIFY(picture.pixelColor(x, 0).blue() > 200);
    }
    const QImage bare = scribble_picture({painted.view(), {}}, labels, {1, 2, 3, 9});
    QCOMPARE(bare.pixelColor(4, 0).alpha(), 0);
  }

 private:
  void pen(QEvent::Type type, QPointF at, QPointingDevice::PointerType end) {
    static const QPointingDevice tip("pen", 1, QInputDevice::DeviceType::Stylus,
                                     QPointingDevice::PointerType::Pen,
                                     QInputDevice::Capability::Position, 1, 1);
    static const QPointingDevice other("eraser", 2, QInputDevice::DeviceType::Stylus,
                                       QPointingDevice::PointerType::Eraser,
                                       QInputDevice::Capability::Position, 1, 1);
    const bool is_down = type != QEvent::TabletRelease;
    QTabletEvent event(type, end == QPointingDevice::PointerType::Pen ? &tip : &other, at,
                       canvas_->mapToGlobal(at), is_down ? 1 : 0, 0, 0, 0, 0, 0, {},
                       type == QEvent::TabletMove ? Qt::NoButton : Qt::LeftButton,
                       is_down ? Qt::LeftButton : Qt::NoButton);
    QApplication::sendEvent(canvas_.get(), &event);
  }

  std::unique_ptr<ViewCanvas> canvas_;
  std::unique_ptr<StrokeTool> tool_;
};

}  // namespace episcope::in_stroke_tool_test

EPISCOPE_WINDOW_TEST(stroke_tool_test, StrokeToolTest)
#include "stroke_tool_test.moc"
