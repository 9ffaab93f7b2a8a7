// SPDX-License-Identifier: BSD-3-Clause
#include "widgets/canvas/tile_wall.h"
#include "tests/window_test_main.h"

#include "tests/widgets/pictures.h"

#include <QScrollBar>
#include <QSignalSpy>

namespace episcope::in_tile_wall_test {

using episcope::test::coordinate_picture;
using episcope::test::turn_wheel;

namespace {

std::vector<Tile> make_tiles(int count) {
  std::vector<Tile> tiles;
  for (int i = 0; i < count; ++i) {
    tiles.push_back({static_cast<quint64>(10 + i),
                     QString("result %1").arg(i),
                     Side::None,
                     coordinate_picture(60, 60),
                     {}});
  }
  return tiles;
}

void show(TileWall& wall, int count, QSize size = {800, 600}) {
  wall.resize(size);
  wall.setTiles(make_tiles(count));
  wall.show();
  QVERIFY(QTest::qWaitForWindowExposed(&wall));
}

void click_pixel(ViewCanvas* canvas, PixelIndex pixel) {
  QTest::mouseClick(canvas, Qt::LeftButton, {}, canvas->positionOf(pixel).toPoint());
}

}  // namespace

class TileWallTest : public QObject {
  Q_OBJECT

 private slots:
  void columns_makePicturesLargest() {
    QCOMPARE(best_columns(1, {100, 100}, {800, 600}), 1);
    QCOMPARE(best_columns(2, {100, 100}, {800, 400}), 2);
    QCOMPARE(best_columns(2, {100, 100}, {400, 800}), 1);
    QCOMPARE(best_columns(4, {100, 100}, {600, 600}), 2);
    QCOMPARE(best_columns(6, {100, 100}, {1600, 400}), 6);
    QCOMPARE(best_columns(6, {100, 100}, {900, 600}), 3);
  }

  void tiles_haveOneSizeAndShowTheWholePicture() {
    TileWall wall;
    show(wall, 5);

    for (int i = 0; i < wall.count(); ++i) {
      QCOMPARE(wall.tile(i)->size(), wall.tile(0)->size());
      QVERIFY(wall.tile(i)->isVisible());
      QCOMPARE(wall.tile(i)->visiblePixels(), QRect(0, 0, 60, 60));
    }
  }

  void manyTiles_scrollInsteadOfVanishing() {
    TileWall wall;
    show(wall, 40, {400, 300});

    QVERIFY(wall.verticalScrollBar()->maximum() > 0);
    QVERIFY(wall.tile(39)->width() >= 160 && wall.tile(39)->height() >= 130);
  }

  void wheelOverOne_zoomsAllAtTheSamePlace() {
    TileWall wall;
    show(wall, 4);
    QSignalSpy zoomed(&wall, &TileWall::zoomChanged);

    turn_wheel(*wall.tile(1), wall.tile(1)->positionOf({10, 20}), 4);

    QVERIFY(!zoomed.isEmpty());
    QVERIFY(wall.zoom().relative_scale > 2);
    for (int i = 0; i < 4; ++i) {
      QCOMPARE(wall.tile(i)->canvasTransform().scale, wall.tile(1)->canvasTransform().scale);
      QCOMPARE(wall.tile(i)->visiblePixels(), wall.tile(1)->visiblePixels());
    }
  }

  void dragInOne_pansAll() {
    TileWall wall;
    show(wall, 3);
    turn_wheel(*wall.tile(0), QPointF(50, 50), 5);
    const QPointF before = wall.tile(2)->canvasTransform().center;

    QTest::mousePress(wall.tile(0), Qt::LeftButton, {}, {100, 100});
    QTest::mouseMove(wall.tile(0), {130, 100});
    QTest::mouseMove(wall.tile(0), {60, 70});
    QTest::mouseRelease(wall.tile(0), Qt::LeftButton, {}, {60, 70});

    QVERIFY(wall.tile(2)->canvasTransform().center != before);
    QCOMPARE(wall.tile(2)->canvasTransform(), wall.tile(0)->canvasTransform());
  }

  void click_choosesTheTileAndThePixel() {
    TileWall wall;
    show(wall, 4);
    QSignalSpy chosen(&wall, &TileWall::chosen);
    QSignalSpy crossed(&wall, &TileWall::crossHairRequested);

    click_pixel(wall.tile(2), {31, 42});

    QCOMPARE(chosen.size(), 1);
    QCOMPARE(chosen[0][0].toULongLong(), quint64(12));
    QVERIFY(crossed[0][0].value<PixelIndex>() == (PixelIndex{31, 42}));
  }

  void crossHair_isInEveryTile() {
    TileWall wall;
    show(wall, 3);

    wall.setCrossHair(PixelIndex{5, 6});

    for (int i = 0; i < 3; ++i) QVERIFY(wall.tile(i)->crossHair() == (PixelIndex{5, 6}));
  }

  void zoom_survivesNewPicturesTilesAndSizes() {
    TileWall wall;
    show(wall, 2);
    turn_wheel(*wall.tile(0), wall.tile(0)->positionOf({30, 30}), 4);
    const LinkedZoom before = wall.zoom();

    wall.setTiles(make_tiles(7));
    QCOMPARE(wall.zoom().center, before.center);
    QVERIFY(std::abs(wall.zoom().relative_scale / before.relative_scale - 1) < 1e-9);
    wall.resize(500, 700);
    QTRY_VERIFY(std::abs(wall.zoom().relative_scale / before.relative_scale - 1) < 1e-9);
  }

  void fewerTiles_hideTheRest() {
    TileWall wall;
    show(wall, 4);

    wall.setTiles(make_tiles(1));

    QCOMPARE(wall.count(), 1);
    int visible = 0;
    for (auto* canvas : wall.findChildren<ViewCanvas*>()) visible += canvas->isVisible() ? 1 : 0;
    QCOMPARE(visible, 1);
    QVERIFY(wall.tile(0)->width() > 700);
  }
};

}  // namespace episcope::in_tile_wall_test

EPISCOPE_WINDOW_TEST(tile_wall_test, TileWallTest)
#include "tile_wall_test.moc"
