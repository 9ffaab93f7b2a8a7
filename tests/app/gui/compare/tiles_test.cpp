// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/compare/compare_controller.h"
#include "app/gui/shell/commands.h"
#include "tests/app/gui/compare/compared.h"
#include "tests/window_test_main.h"
#include "widgets/canvas/tile_wall.h"
#include "widgets/canvas/view_canvas.h"
#include "widgets/controls/text.h"

#include <cmath>

namespace episcope::in_tiles_test {

// Every view and result side by side.
class TilesTest : public QObject {
  Q_OBJECT

 private slots:
  void keyG_showsTheViewTheTruthAndEveryResult();
  void tiles_keepTheRegionInSight();
  void clickOnATile_showsItsResultAndMovesTheCrossHair();
  void tileOfTheView_printsItsSamples();
  void tilesOfErrors_differByResult();
  void tilesBesideDifferences_tellTheirColors();
  void newResult_joinsTheTiles();
  void escape_leavesTheTiles();
};

void TilesTest::keyG_showsTheViewTheTruthAndEveryResult() {
  Compared f({0.1F, 0.2F});
  QTRY_VERIFY_WITH_TIMEOUT(f.window.bench().commands.find("compare.tiles")->isEnabled(), kPatience);

  f.key(Qt::Key_G);

  QTRY_COMPARE_WITH_TIMEOUT(f.wall()->count(), 4, kPatience);
  QVERIFY(f.wall()->isVisible());
  QVERIFY(!f.canvas()->isVisible());
  QVERIFY(f.window.bench().commands.find("compare.tiles")->isChecked());
  for (int i = 0; i < 4; ++i) QCOMPARE(f.wall()->tile(i)->picture().size(), QSize(96, 96));

  f.key(Qt::Key_G);
  QTRY_VERIFY_WITH_TIMEOUT(f.canvas()->isVisible(), kPatience);
  QVERIFY(!f.wall()->isVisible());
}

void TilesTest::tiles_keepTheRegionInSight() {
  Compared f({0.1F});
  f.canvas()->setCanvasTransform({f.canvas()->fitScale() * 4, {30, 40}});

  f.trigger("compare.tiles");
  QTRY_COMPARE_WITH_TIMEOUT(f.wall()->count(), 3, kPatience);
  QCOMPARE(f.wall()->zoom().center, QPointF(30, 40));
  QVERIFY(std::abs(f.wall()->zoom().relative_scale - 4) < 1e-6);

  f.trigger("view.zoom_in");
  f.trigger("compare.tiles");
  QTRY_VERIFY(std::abs(zoom_of(*f.canvas()).relative_scale - 4 * kCanvasZoomStep) < 1e-6);
}

void TilesTest::clickOnATile_showsItsResultAndMovesTheCrossHair() {
  Compared f({0.1F, 0.2F, 0.3F});
  f.trigger("compare.tiles");
  QTRY_COMPARE_WITH_TIMEOUT(f.wall()->count(), 5, kPatience);

  click_pixel(f.wall()->tile(2), {20, 33});  // after the view and the truth

  QCOMPARE(f.session().shown()->id, f.ids[0]);
  QVERIFY(f.session().cross_hair() == (PixelIndex{20, 33}));
  QTRY_VERIFY_WITH_TIMEOUT(f.wall()->tile(4)->crossHair() == (PixelIndex{20, 33}), kPatience);

  QTest::mouseDClick(f.wall()->tile(3), Qt::LeftButton);
  QCOMPARE(f.session().shown()->id, f.ids[1]);
  QCOMPARE(find<CompareController>(f.window).mode(), CompareMode::Single);
}

void TilesTest::tileOfTheView_printsItsSamples() {
  Compared f({0.1F});
  f.trigger("compare.tiles");
  QTRY_COMPARE_WITH_TIMEOUT(f.wall()->count(), 3, kPatience);
  ViewCanvas* tile = f.wall()->tile(0);

  f.wall()->setZoom({100 / tile->fitScale(), {30.5, 40.5}});  // 100 pixels of the screen a pixel

  const QPoint middle = tile->positionOf({40, 30}).toPoint();
  const QImage pixel = tile->grab(QRect(middle - QPoint(40, 40), QSize(80, 80))).toImage();
  bool is_flat = true;
  for (int y = 0; y < pixel.height(); ++y) {
    for (int x = 0; x < pixel.width(); ++x) is_flat &= pixel.pixel(x, y) == pixel.pixel(0, 0);
  }
  QVERIFY(!is_flat);
}

void TilesTest::tilesOfErrors_differByResult() {
  Compared f({0.0F, 0.15F});
  f.trigger("compare.tiles");
  QTRY_COMPARE_WITH_TIMEOUT(f.wall()->count(), 4, kPatience);

  f.window.bench().overlay.setQuantity(render::Quantity::SignedError);

  // White is no error, red is too far: the second result is redder in the middle of the picture.
  const auto color = [&f](int tile) { return f.wall()->tile(tile)->picture().pixelColor(48, 48); };
  QTRY_VERIFY_WITH_TIMEOUT(color(2) != color(3), kPatience);
  QCOMPARE(f.wall()->tile(0)->picture(),
           f.canvas()->picture().convertToFormat(QImage::Format_RGB32));
}

// The legend is that of the differences.
void TilesTest::tilesBesideDifferences_tellTheirColors() {
  Compared f({0.1F, 0.2F, 0.3F});
  f.session().compare_with(f.ids[0]);
  f.trigger("compare.tiles");
  QTRY_COMPARE_WITH_TIMEOUT(f.wall()->count(), 5, kPatience);
  const auto caption = [&f](int tile) { return f.wall()->tile(tile)->caption(); };
  QCOMPARE(caption(1), QString("ground truth"));

  f.trigger("compare.difference");

  QTRY_COMPARE_WITH_TIMEOUT(caption(3), QString("off 2 − off"), kPatience);
  QCOMPARE(caption(4), QString("off 3 − off"));
  const Interval range = f.window.bench().overlay.shadingOf(render::Quantity::Disparity).range;
  const QString colors =
      QString(" · %1 … %2 px").arg(number_text(range.min, 2), number_text(range.max, 2));
  QCOMPARE(caption(1), "ground truth" + colors);
  QCOMPARE(caption(2), "disparity of off" + colors);
}

void TilesTest::newResult_joinsTheTiles() {
  Compared f({0.1F});
  f.trigger("compare.tiles");
  QTRY_COMPARE_WITH_TIMEOUT(f.wall()->count(), 3, kPatience);

  f.add(0.2F);
  QTRY_COMPARE_WITH_TIMEOUT(f.wall()->count(), 4, kPatience);
  f.session().remove_estimate(f.ids[0]);
  QTRY_COMPARE_WITH_TIMEOUT(f.wall()->count(), 3, kPatience);
}

void TilesTest::escape_leavesTheTiles() {
  Compared f({0.1F});
  f.trigger("compare.tiles");
  QTRY_COMPARE_WITH_TIMEOUT(f.wall()->count(), 3, kPatience);

  f.key(Qt::Key_Escape);

  QTRY_VERIFY_WITH_TIMEOUT(f.canvas()->isVisible(), kPatience);
}

}  // namespace episcope::in_tiles_test

EPISCOPE_WINDOW_TEST(tiles_test, TilesTest)
#include "tiles_test.moc"
