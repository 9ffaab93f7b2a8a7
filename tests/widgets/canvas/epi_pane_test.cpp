// SPDX-License-Identifier: BSD-3-Clause
#include "tests/widgets/pictures.h"
#include "tests/window_test_main.h"
#include "widgets/canvas/epi_pane.h"

#include <QSignalSpy>

#include <cmath>
#include <memory>
#include <tuple>

namespace episcope::in_epi_pane_test {

using episcope::test::color_count;
using episcope::test::coordinate_picture;

namespace {

constexpr int kLength = 100;
constexpr int kRows = 9;

}  // namespace

class EpiPaneTest : public QObject {
  Q_OBJECT

  void addOrientations() {
    QTest::addColumn<Qt::Orientation>("orientation");
    QTest::addColumn<bool>("may_lie");
    QTest::newRow("horizontal") << Qt::Horizontal << false;
    QTest::newRow("vertical") << Qt::Vertical << false;
    QTest::newRow("vertical, on its side") << Qt::Vertical << true;
  }

  std::unique_ptr<EpiPane> makePane(Qt::Orientation orientation, bool may_lie = false) {
    auto pane = std::make_unique<EpiPane>(orientation);
    pane->setMayLie(may_lie);
    const bool is_wide = orientation == Qt::Horizontal || may_lie;
    pane->resize(is_wide ? QSize(400, 90) : QSize(90, 400));
    pane->setEpi(coordinate_picture(kLength, kRows));
    pane->setCanvasTransform({4, {50, 50}});
    pane->show();
    return pane;
  }

 private slots:
  void rows_areSeveralPixelsTall_data() { addOrientations(); }
  void rows_areSeveralPixelsTall() {
    QFETCH(Qt::Orientation, orientation);
    QFETCH(bool, may_lie);

    const auto pane = makePane(orientation, may_lie);

    QCOMPARE(pane->rowExtent(), 10.0);
  }

  void picture_isDrawnWherePositionOfSays_data() { addOrientations(); }
  void picture_isDrawnWherePositionOfSays() {
    QFETCH(Qt::Orientation, orientation);
    QFETCH(bool, may_lie);
    const auto pane = makePane(orientation, may_lie);

    const QImage shown = pane->grab().toImage();

    for (const auto& [along, row] : {std::pair(60, 3), std::pair(33, 5), std::pair(80, 4)}) {
      const QRgb color = shown.pixel(pane->positionOf(along + 0.5, row + 0.5).toPoint());
      QCOMPARE(qRed(color), along);
      QCOMPARE(qGreen(color), row);
    }
  }

  void drag_measuresTheDisparityOfTheLine_data() {
    QTest::addColumn<Qt::Orientation>("orientation");
    QTest::addColumn<bool>("may_lie");
    QTest::addColumn<double>("disparity");
    QTest::addColumn<double>("focus");
    const std::tuple<const char*, Qt::Orientation, bool> panes[] = {
        {"horizontal", Qt::Horizontal, false},
        {"vertical", Qt::Vertical, false},
        {"vertical, on its side", Qt::Vertical, true}};
    for (const auto& [name, orientation, may_lie] : panes) {
      for (const double disparity : {-2.0, 0.0, 0.5, 3.0}) {
        QTest::addRow("%s %g", name, disparity) << orientation << may_lie << disparity << 0.0;
        QTest::addRow("%s %g sheared", name, disparity)
            << orientation << may_lie << disparity << 0.75;
      }
    }
  }

  void drag_measuresTheDisparityOfTheLine() {
    QFETCH(Qt::Orientation, orientation);
    QFETCH(double, disparity);
    QFETCH(double, focus);
    QFETCH(bool, may_lie);
    const auto pane = makePane(orientation, may_lie);
    pane->setFocus(focus);
    QSignalSpy measured(pane.get(), &EpiPane::disparityMeasured);
    QSignalSpy clicked(pane.get(), &EpiPane::positionClicked);
    // A point at 50 in row 1 is found at 50 − (d − focus)·6 in row 7.
    const QPoint from = pane->positionOf(50, 1).toPoint();
    const QPoint to = pane->positionOf(50 - (disparity - focus) * 6, 7).toPoint();

    QTest::mousePress(pane.get(), Qt::LeftButton, {}, from);
    QTest::mouseMove(pane.get(), to);
    QTest::mouseRelease(pane.get(), Qt::LeftButton, {}, to);

    QCOMPARE(measured.size(), 1);
    QCOMPARE(clicked.size(), 0);
    // Mouse positions are whole: half a screen pixel of 4 per image pixel, over 6 rows.
    QVERIFY(std::abs(measured[0][0].toDouble() - disparity) < 0.5 / 4 / 6 + 1e-6);
    QCOMPARE(*pane->measuredDisparity(), measured[0][0].toDouble());
  }

  void dragAlongARow_measuresNothing() {
    const auto pane = makePane(Qt::Horizontal);
    QSignalSpy measured(pane.get(), &EpiPane::disparityMeasured);

    QTest::mousePress(pane.get(), Qt::LeftButton, {}, {100, 40});
    QTest::mouseMove(pane.get(), {200, 42});
    QTest::mouseRelease(pane.get(), Qt::LeftButton, {}, {200, 42});

    QCOMPARE(measured.size(), 0);
    QVERIFY(!pane->measuredDisparity());
  }

  void newFocus_forgetsTheLineDrawnByHand() {
    const auto pane = makePane(Qt::Horizontal);
    QTest::mousePress(pane.get(), Qt::LeftButton, {}, {100, 10});
    QTest::mouseMove(pane.get(), {110, 80});
    QTest::mouseRelease(pane.get(), Qt::LeftButton, {}, {110, 80});
    QVERIFY(pane->measuredDisparity());

    pane->setFocus(1);

    QVERIFY(!pane->measuredDisparity());
  }

  void click_asksForPixelAndRow_data() { addOrientations(); }
  void click_asksForPixelAndRow() {
    QFETCH(Qt::Orientation, orientation);
    QFETCH(bool, may_lie);
    const auto pane = makePane(orientation, may_lie);
    QSignalSpy clicked(pane.get(), &EpiPane::positionClicked);

    QTest::mouseClick(pane.get(), Qt::LeftButton, {}, pane->positionOf(72.5, 6.5).toPoint());

    QCOMPARE(clicked.size(), 1);
    QCOMPARE(clicked[0][0].toInt(), 72);
    QCOMPARE(clicked[0][1].toInt(), 6);
  }

  void slopeLines_passWhereThePointIsSeen_data() { addOrientations(); }
  void slopeLines_passWhereThePointIsSeen() {
    QFETCH(Qt::Orientation, orientation);
    QFETCH(bool, may_lie);
    const auto pane = makePane(orientation, may_lie);
    QImage black(kLength, kRows, QImage::Format_RGB32);
    black.fill(Qt::black);
    pane->setEpi(black);
    pane->setFocus(0.5);
    pane->setCrossHair(50, 4);
    pane->setSlopes(std::nullopt, 2.5);

    const QImage shown = pane->grab().toImage();

    // Disparity 2.5 on an EPI sheared by 0.5: two pixels a row, to the left for later views.
    const QRgb later = shown.pixel(pane->positionOf(50.5 - 2 * 3, 7.5).toPoint());
    const QRgb earlier = shown.pixel(pane->positionOf(50.5 + 2 * 2, 2.5).toPoint());
    const QRgb mirrored = shown.pixel(pane->positionOf(50.5 + 2 * 3, 7.5).toPoint());
    QVERIFY(qGreen(later) > 150);
    QVERIFY(qGreen(earlier) > 150);
    QVERIFY(qGreen(mirrored) < 50);
  }

  void wheel_zoomsTheSharedAxisOnly() {
    const auto pane = makePane(Qt::Horizontal);
    connect(pane.get(), &EpiPane::transformChanged, pane.get(), &EpiPane::setCanvasTransform);
    QSignalSpy changed(pane.get(), &EpiPane::transformChanged);
    const QPointF at(310, 80);

    test::turn_wheel(*pane, at, 2);

    QCOMPARE(changed.size(), 1);
    const auto transform = changed[0][0].value<CanvasTransform>();
    QCOMPARE(transform.center.y(), 50.0);
    QCOMPARE(transform.to_image(at, pane->size()).x(), 50 + 110 / 4.0);
  }

  void wheel_onAPaneThatLies_zoomsTheRowsOfTheView() {
    const auto pane = makePane(Qt::Vertical, true);
    pane->setCanvasTransform({4, {30, 50}});
    QSignalSpy changed(pane.get(), &EpiPane::transformChanged);

    test::turn_wheel(*pane, {310, 80}, 2);

    const auto transform = changed.at(0).at(0).value<CanvasTransform>();
    QCOMPARE(transform.center.x(), 30.0);
    // What was at the hand stays there: 110 px from the middle.
    QCOMPARE(transform.center.y() + 110 / transform.scale, 50 + 110 / 4.0);
  }

  void paneBesideACanvas_neverLies() {
    const auto pane = makePane(Qt::Vertical);
    pane->resize(400, 90);
    QCOMPARE(pane->rowExtent(), 400.0 / kRows);
    pane->setMayLie(true);
    QCOMPARE(pane->rowExtent(), 10.0);
  }

  void zoomedOut_mixesPixelsButNotRows() {
    const auto pane = makePane(Qt::Horizontal);
    QImage striped(kLength, kRows, QImage::Format_RGB32);
    for (int row = 0; row < kRows; ++row) {
      for (int x = 0; x < kLength; ++x) striped.setPixel(x, row, row % 2 ? 0xffffffff : 0xff000000);
    }
    pane->setEpi(striped);
    pane->setCanvasTransform({0.5, {50, 50}});

    const QImage shown = pane->grab().toImage();

    for (int row = 2; row < 6; ++row) {
      const QRgb color = shown.pixel(pane->positionOf(50, row + 0.5).toPoint());
      QCOMPARE(qGray(color), row % 2 ? 255 : 0);
    }
  }

  void emptyPane_saysWhatItIs() {
    EpiPane pane(Qt::Horizontal);
    pane.resize(300, 90);

    QVERIFY(color_count(pane.grab().toImage()) > 2);
  }
};

}  // namespace episcope::in_epi_pane_test

EPISCOPE_WINDOW_TEST(epi_pane_test, EpiPaneTest)
#include "epi_pane_test.moc"
