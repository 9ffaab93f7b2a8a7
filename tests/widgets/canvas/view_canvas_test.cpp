// SPDX-License-Identifier: BSD-3-Clause
#include "widgets/canvas/view_canvas.h"
#include "tests/widgets/pictures.h"
#include "tests/window_test_main.h"
#include "widgets/canvas/canvas_geometry.h"
#include "widgets/controls/picture.h"

#include <QPainter>
#include <QSignalSpy>

#include <cmath>
#include <memory>

namespace episcope::in_view_canvas_test {

using episcope::test::color_count;
using episcope::test::coordinate_picture;
using episcope::test::turn_wheel;

class ViewCanvasTest : public QObject {
  Q_OBJECT

 private slots:
  void init() {
    canvas_ = std::make_unique<ViewCanvas>();
    canvas_->resize(400, 300);
    canvas_->setPicture(coordinate_picture(80, 60));
    canvas_->show();
    QVERIFY(QTest::qWaitForWindowExposed(canvas_.get()));
  }
  void cleanup() { canvas_.reset(); }

  void longCaption_staysInItsTile() {
    QImage picture(120, 80, QImage::Format_RGB32);
    QPainter painter(&picture);
    const QRectF tile(0, 0, 120, 80);

    const QRectF plate =
        draw_plate(painter, tile, Qt::AlignLeft | Qt::AlignTop,
                   "PLANE_PM, smoothness 0.25, smoothness of labels 12", Qt::white, Side::A);

    QVERIFY(tile.contains(plate));
    QVERIFY(plate.width() > 100);
  }

  void longCaption_keepsItsShortParts() {
    const QFontMetricsF metrics(canvas_->font());
    const QString text = "result 12 of a long evening with many parameters · MSE×100 0.80";

    const QString fitted = fitted_caption(text, metrics, metrics.horizontalAdvance(text) / 2);

    QVERIFY2(fitted.endsWith(" · MSE×100 0.80"), qPrintable(fitted));
    QVERIFY(metrics.horizontalAdvance(fitted) <= metrics.horizontalAdvance(text) / 2);
    QCOMPARE(fitted_caption(text, metrics, 10'000), text);
  }

  void shortName_isShortenedBeforeItsNumber() {
    const QFontMetricsF metrics(canvas_->font());
    const QString text = "PLANE_PM · MSE×100 1.40";

    const QString fitted = fitted_caption(text, metrics, metrics.horizontalAdvance(text) - 20);

    QVERIFY2(fitted.endsWith(" · MSE×100 1.40"), qPrintable(fitted));
  }

  void wheel_keepsThePixelUnderTheCursor_data() {
    QTest::addColumn<QPointF>("at");
    QTest::addColumn<double>("notches");
    QTest::newRow("middle") << QPointF(200, 150) << 4.0;
    QTest::newRow("corner in") << QPointF(31.0, 32.0) << 5.0;
    QTest::newRow("right, far in") << QPointF(355, 140) << 9.0;
  }

  void wheel_keepsThePixelUnderTheCursor() {
    QFETCH(QPointF, at);
    QFETCH(double, notches);
    const auto before = canvas_->pixelAt(at);
    const double scale = canvas_->canvasTransform().scale;

    turn_wheel(*canvas_, at, notches);

    QVERIFY(before.has_value());
    QVERIFY(canvas_->pixelAt(at) == before);
    QVERIFY(canvas_->canvasTransform().scale > 2 * scale);
  }

  void click_asksForThePixelThatIsDrawnThere_data() {
    QTest::addColumn<double>("scale");
    for (const double scale : {0.5, 1.0, 3.7, 16.0, 100.0}) {
      QTest::addRow("scale %g", scale) << scale;
    }
  }

  void click_asksForThePixelThatIsDrawnThere() {
    QFETCH(double, scale);
    canvas_->setCanvasTransform({scale, {40.25, 30.5}});
    const QPoint at(207, 143);
    QSignalSpy clicks(canvas_.get(), &ViewCanvas::crossHairRequested);

    QTest::mouseClick(canvas_.get(), Qt::LeftButton, {}, at);

    QCOMPARE(clicks.size(), 1);
    const auto pixel = clicks[0][0].value<PixelIndex>();
    if (scale < 1) return;  // Several pixels share one of the screen.
    const QRgb drawn = canvas_->grab().toImage().pixel(at);
    QCOMPARE(pixel.x, qRed(drawn));
    QCOMPARE(pixel.y, qGreen(drawn));
  }

  void clickOutside_asksForNothing() {
    QSignalSpy clicks(canvas_.get(), &ViewCanvas::crossHairRequested);
    canvas_->setCanvasTransform({1, {40, 30}});

    QTest::mouseClick(canvas_.get(), Qt::LeftButton, {}, {5, 5});

    QCOMPARE(clicks.size(), 0);
  }

  void magnification_showsPixelsWithHardEdges() {
    canvas_->setCanvasTransform({32, {40, 30}});

    const QImage shown = canvas_->grab().toImage().copy(100, 80, 160, 128);

    // Every color on screen is a color of the picture: nothing is mixed between pixels.
    for (int y = 0; y < shown.height(); ++y) {
      for (int x = 0; x < shown.width(); ++x) QCOMPARE(qBlue(shown.pixel(x, y)), 128);
    }
    QVERIFY(color_count(shown) <= 6 * 5);
  }

  void shiftClick_asksForFocus() {
    QSignalSpy focus(canvas_.get(), &ViewCanvas::focusRequested);
    QSignalSpy clicks(canvas_.get(), &ViewCanvas::crossHairRequested);

    QTest::mouseClick(canvas_.get(), Qt::LeftButton, Qt::ShiftModifier, {200, 150});

    QCOMPARE(focus.size(), 1);
    QVERIFY(focus[0][0].value<PixelIndex>() == (PixelIndex{30, 40}));
    QCOMPARE(clicks.size(), 0);
  }

  void doubleClick_asksForTheCentreView() {
    QSignalSpy center(canvas_.get(), &ViewCanvas::centerRequested);

    QTest::mouseDClick(canvas_.get(), Qt::LeftButton, {}, {200, 150});

    QCOMPARE(center.size(), 1);
  }

  void drag_isParallaxAgainstTheHand() {
    QSignalSpy started(canvas_.get(), &ViewCanvas::parallaxStarted);
    QSignalSpy dragged(canvas_.get(), &ViewCanvas::parallaxDragged);
    QSignalSpy clicks(canvas_.get(), &ViewCanvas::crossHairRequested);
    const auto before = canvas_->canvasTransform();

    QTest::mousePress(canvas_.get(), Qt::LeftButton, {}, {100, 100});
    QTest::mouseMove(canvas_.get(), {164, 68});
    QTest::mouseRelease(canvas_.get(), Qt::LeftButton, {}, {164, 68});

    QCOMPARE(started.size(), 1);
    QCOMPARE(clicks.size(), 0);
    // 64 px right and 32 px up: two views to the left and one down.
    QCOMPARE(dragged.last()[0].toPointF(), QPointF(-2, 1));
    QVERIFY(canvas_->canvasTransform() == before);
  }

  void middleDrag_pans() {
    canvas_->setCanvasTransform({8, {40, 30}});
    QSignalSpy parallax(canvas_.get(), &ViewCanvas::parallaxStarted);

    QTest::mousePress(canvas_.get(), Qt::MiddleButton, {}, {100, 100});
    QTest::mouseMove(canvas_.get(), {140, 92});
    QTest::mouseRelease(canvas_.get(), Qt::MiddleButton, {}, {140, 92});

    QCOMPARE(canvas_->canvasTransform().center, QPointF(35, 31));
    QCOMPARE(parallax.size(), 0);
  }

  void spaceDrag_pansAndIsNoTap() {
    canvas_->setCanvasTransform({8, {40, 30}});
    QSignalSpy tapped(canvas_.get(), &ViewCanvas::spaceTapped);

    QTest::keyPress(canvas_.get(), Qt::Key_Space);
    QTest::mousePress(canvas_.get(), Qt::LeftButton, {}, {100, 100});
    QTest::mouseMove(canvas_.get(), {116, 100});
    QTest::mouseRelease(canvas_.get(), Qt::LeftButton, {}, {116, 100});
    QTest::keyRelease(canvas_.get(), Qt::Key_Space);

    QCOMPARE(canvas_->canvasTransform().center, QPointF(38, 30));
    QCOMPARE(tapped.size(), 0);
  }

  void spaceTap_isTold() {
    QSignalSpy tapped(canvas_.get(), &ViewCanvas::spaceTapped);

    QTest::keyClick(canvas_.get(), Qt::Key_Space);

    QCOMPARE(tapped.size(), 1);
  }

  void zoom_keepsThePixelUnderTheMouse() {
    QTest::mouseMove(canvas_.get(), {120, 90});
    const auto under = canvas_->pixelAt({120, 90});
    const double scale = canvas_->canvasTransform().scale;

    canvas_->zoomIn();
    QVERIFY(canvas_->canvasTransform().scale > scale);
    QVERIFY(canvas_->pixelAt({120, 90}) == under);
    canvas_->zoomOut();
    QCOMPARE(canvas_->canvasTransform().scale, scale);
    canvas_->zoomToActualSize();
    QCOMPARE(canvas_->canvasTransform().scale, 1 / canvas_->devicePixelRatioF());
    canvas_->zoomToFit();
    QVERIFY(canvas_->isFitted());
    QCOMPARE(canvas_->canvasTransform().scale, scale);
  }

  void fit_followsTheSizeUntilTheUserZooms() {
    canvas_->resize(800, 600);
    QTRY_VERIFY(std::abs(canvas_->canvasTransform().scale - 592.0 / 60) < 1e-9);
    turn_wheel(*canvas_, {400, 300}, 1);
    const auto zoomed = canvas_->canvasTransform();

    canvas_->resize(500, 400);

    QVERIFY(canvas_->canvasTransform() == zoomed);
  }

  void newPictureOfTheSameSize_keepsTheZoom() {
    canvas_->setCanvasTransform({20, {10, 10}});

    canvas_->setPicture(coordinate_picture(80, 60));

    QVERIFY(canvas_->canvasTransform() == (CanvasTransform{20, {10, 10}}));
  }

  void linkedCanvases_shareZoomAndPan() {
    ViewCanvas other;
    other.resize(300, 300);
    other.setPicture(coordinate_picture(80, 60));
    connect(canvas_.get(), &ViewCanvas::transformChanged, &other, &ViewCanvas::setCanvasTransform);
    connect(&other, &ViewCanvas::transformChanged, canvas_.get(), &ViewCanvas::setCanvasTransform);

    turn_wheel(*canvas_, {60, 70}, 3);
    QVERIFY(other.canvasTransform() == canvas_->canvasTransform());
    turn_wheel(other, {10, 10}, -1);
    QVERIFY(other.canvasTransform() == canvas_->canvasTransform());
  }

  void pan_neverLosesThePicture() {
    canvas_->setCanvasTransform({4, {1e6, -1e6}});

    QCOMPARE(canvas_->canvasTransform().center, QPointF(80, 0));
  }

  void hover_tellsThePixelAndItsEnd() {
    QSignalSpy moves(canvas_.get(), &ViewCanvas::cursorMoved);

    QTest::mouseMove(canvas_.get(), {200, 150});
    QTest::mouseMove(canvas_.get(), {1, 1});

    QVERIFY(moves.size() >= 2);
    QVERIFY(moves[0][0].value<std::optional<PixelIndex>>() == (PixelIndex{30, 40}));
    QVERIFY(!moves.last()[0].value<std::optional<PixelIndex>>());
  }

  void altWheel_stepsTheFocusPlane() {
    QSignalSpy focus(canvas_.get(), &ViewCanvas::focusStepped);
    const auto before = canvas_->canvasTransform();

    turn_wheel(*canvas_, {200, 150}, -1, Qt::AltModifier);

    QCOMPARE(focus.size(), 1);
    QCOMPARE(focus[0][0].toDouble(), -1.0);
    QVERIFY(canvas_->canvasTransform() == before);
  }

  void ensureVisible_bringsAPixelIntoSight() {
    canvas_->setCanvasTransform({40, {5, 5}});

    canvas_->ensureVisible({50, 70});

    QVERIFY(QRectF(canvas_->rect()).contains(canvas_->positionOf({50, 70})));
  }

  void overlay_isMixedByItsOpacity_data() {
    QTest::addColumn<double>("opacity");
    QTest::addColumn<int>("red");
    QTest::newRow("none") << 0.0 << 0;
    QTest::newRow("half") << 0.5 << 128;
    QTest::newRow("full") << 1.0 << 255;
  }

  void overlay_isMixedByItsOpacity() {
    QFETCH(double, opacity);
    QFETCH(int, red);
    QImage black(80, 60, QImage::Format_RGB32);
    black.fill(Qt::black);
    QImage overlay(80, 60, QImage::Format_RGB32);
    overlay.fill(Qt::red);
    canvas_->setPicture(black);

    canvas_->setOverlay(overlay);
    canvas_->setOverlayOpacity(opacity);

    const int shown = qRed(canvas_->grab().toImage().pixel(200, 150));
    QVERIFY2(std::abs(shown - red) <= 1, qPrintable(QString::number(shown)));  // 8-bit rounding.
  }

  void pixelText_isPrintedWhenPixelsAreLarge() {
    int asked = 0;
    canvas_->setPixelText([&](int y, int x) {
      ++asked;
      return QStringList{QString::number(x), QString::number(y)};
    });
    canvas_->setCanvasTransform({20, {40, 30}});
    canvas_->grab();
    QCOMPARE(asked, 0);

    canvas_->setCanvasTransform({100, {40.5, 30.5}});
    const QImage shown = canvas_->grab().toImage();

    QVERIFY(asked > 0);
    // Pixel (30, 40) fills the middle: with letters in it, it has more than one color.
    QVERIFY(color_count(shown.copy(155, 105, 90, 90)) > 1);
  }

  void crossHair_isDrawnThroughItsPixel() {
    canvas_->setCanvasTransform({8, {40, 30}});
    const QImage before = canvas_->grab().toImage();

    canvas_->setCrossHair(PixelIndex{30, 40});

    const QImage after = canvas_->grab().toImage();
    const QPoint at = canvas_->positionOf({30, 40}).toPoint();
    QVERIFY(before.pixel(at.x(), 60) != after.pixel(at.x(), 60));
    QVERIFY(before.pixel(60, at.y()) != after.pixel(60, at.y()));
    QCOMPARE(after.pixel(at), before.pixel(at));  // The pixel itself stays free.
  }

  void statesWithoutPicture_areDrawn() {
    canvas_->setEmptyHint("Open a light field.");
    canvas_->showEmpty();
    const QImage empty = canvas_->grab().toImage();
    canvas_->showLoading("cotton", 0.5);
    const QImage loading = canvas_->grab().toImage();
    canvas_->showLoading("cotton", 0.9);
    const QImage later = canvas_->grab().toImage();
    canvas_->showError("lf.h5 is truncated.");
    const QImage failed = canvas_->grab().toImage();

    for (const auto& image : {empty, loading, failed}) QVERIFY(color_count(image) > 2);
    QVERIFY(empty != loading && loading != failed && empty != failed);
    QVERIFY(loading != later);
    QCOMPARE(canvas_->state(), ViewCanvas::State::Failed);
    canvas_->setPicture(coordinate_picture(80, 60));
    QCOMPARE(canvas_->state(), ViewCanvas::State::Picture);
  }

  void toQimage_takesTheSamplesOverWithoutACopy() {
    Image<std::uint8_t> rgba(2, 3, 4, 255);
    rgba.at(1, 2, 0) = 7;
    const auto* samples = rgba.data();

    const QImage image = to_qimage(std::move(rgba));

    QCOMPARE(image.size(), QSize(3, 2));
    QCOMPARE(image.constBits(), samples);
    QCOMPARE(qRed(image.pixel(2, 1)), 7);
    QVERIFY(to_qimage({}).isNull());
  }

 private:
  std::unique_ptr<ViewCanvas> canvas_;
};

}  // namespace episcope::in_view_canvas_test

EPISCOPE_WINDOW_TEST(view_canvas_test, ViewCanvasTest)
#include "view_canvas_test.moc"
