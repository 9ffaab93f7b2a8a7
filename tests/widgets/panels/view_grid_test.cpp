// SPDX-License-Identifier: BSD-3-Clause
#include "widgets/panels/view_grid.h"
#include "engine/render/movie.h"
#include "tests/widgets/pictures.h"
#include "tests/window_test_main.h"
#include "widgets/controls/theme.h"

#include <QComboBox>
#include <QSignalSpy>
#include <QToolButton>

#include <cstdlib>

Q_DECLARE_METATYPE(episcope::ViewIndex)

namespace episcope::in_view_grid_test {

class ViewGridTest : public QObject {
  Q_OBJECT

 private slots:
  void everyCell_isClickable_data() {
    QTest::addColumn<int>("v");
    QTest::addColumn<int>("u");
    QTest::newRow("1x1") << 1 << 1;
    QTest::newRow("3x3") << 3 << 3;
    QTest::newRow("5x9") << 5 << 9;
    QTest::newRow("17x17") << 17 << 17;
    QTest::newRow("1x49") << 1 << 49;
    QTest::newRow("25x1") << 25 << 1;
  }

  void everyCell_isClickable() {
    QFETCH(int, v);
    QFETCH(int, u);
    ViewGridCells cells;
    cells.setGrid({v, u});
    cells.resize(190, 190);
    QSignalSpy clicked(&cells, &ViewGridCells::viewClicked);

    for (int row = 0; row < v; ++row) {
      for (int column = 0; column < u; ++column) {
        const QPoint at = cells.cellRect({row, column}).center().toPoint();
        QTest::mouseClick(&cells, Qt::LeftButton, {}, at);
        QCOMPARE(clicked.takeLast()[0].value<ViewIndex>(), (ViewIndex{row, column}));
      }
    }
    QVERIFY(cells.rect().contains(cells.cellRect({v - 1, u - 1}).toRect().adjusted(0, 0, -1, -1)));
  }

  void withoutViews_itSaysWhetherSomeAreComing() {
    ViewGrid grid;
    grid.resize(190, 260);
    const QImage empty = grid.grab().toImage();

    grid.setOpening(true);
    QVERIFY(grid.grab().toImage() != empty);
    grid.setOpening(false);
    QCOMPARE(grid.grab().toImage(), empty);
  }

  void cellsOfFlatViews_areHighEnoughToBeAimedAt() {
    ViewGridCells cells;
    cells.setGrid({5, 5});
    cells.resize(190, 190);
    cells.setThumbnail({0, 0}, QImage(40, 2, QImage::Format_RGB32));
    QVERIFY(cells.cellRect({0, 0}).height() > 10);
    cells.setThumbnail({0, 0}, QImage(2, 40, QImage::Format_RGB32));
    QVERIFY(cells.cellRect({0, 0}).width() > 10);
  }

  void cellsOfAScan_areHighEnoughToBeAimedAt() {
    ViewGridCells cells;
    cells.setGrid({1, 49});
    cells.resize(190, 190);
    QVERIFY(cells.cellRect({0, 0}).height() > 20);
    QVERIFY(cells.heightForWidth(190) > 20);
    cells.setGrid({49, 1});
    QVERIFY(cells.cellRect({0, 0}).width() > 20);
  }

  void currentAndThumbnails_areDrawn() {
    ViewGridCells cells;
    cells.setGrid({3, 3});
    cells.resize(150, 150);
    QImage blue(8, 8, QImage::Format_RGB32);
    blue.fill(Qt::blue);
    cells.setThumbnail({0, 2}, blue);
    const QImage centre = cells.grab().toImage();

    cells.setCurrent({2, 0});

    const QImage corner = cells.grab().toImage();
    QCOMPARE(centre.pixelColor(cells.cellRect({0, 2}).center().toPoint()), QColor(Qt::blue));
    const auto area = [&](const QImage& image, ViewIndex view) {
      return image.copy(cells.cellRect(view).toRect());
    };
    QVERIFY(area(centre, {1, 1}) != area(corner, {1, 1}));
    QVERIFY(area(centre, {2, 0}) != area(corner, {2, 0}));
  }

  void paintedViews_areMarked() {
    ViewGridCells cells;
    cells.setGrid({3, 3});
    cells.resize(150, 150);
    const QImage before = cells.grab().toImage();

    cells.setPainted({{0, 2}, {7, 7}});  // one lies outside

    const QImage after = cells.grab().toImage();
    const QPoint corner = cells.cellRect({0, 2}).topRight().toPoint() + QPoint(-6, 3);
    QCOMPARE(after.pixelColor(corner), theme::kPainted);
    QCOMPARE(after.copy(cells.cellRect({2, 0}).toRect()),
             before.copy(cells.cellRect({2, 0}).toRect()));
    cells.setPainted({});
    QCOMPARE(cells.grab().toImage(), before);
  }

  void viewsThatAreDone_areMarked() {
    ViewGridCells cells;
    cells.setGrid({3, 3});
    cells.resize(150, 150);
    const QImage before = cells.grab().toImage();

    cells.setDone({{0, 2}, {7, 7}});  // one lies outside

    const QRect cell = cells.cellRect({0, 2}).toRect();
    QCOMPARE(cells.grab().toImage().pixelColor(cell.center().x(), cell.bottom() - 4),
             theme::kPainted);
    cells.setDone({});
    QCOMPARE(cells.grab().toImage(), before);
  }

  void play_passesEveryViewOfTheSnake() {
    ViewGrid grid;
    grid.setGrid({3, 3});
    auto* path = grid.findChild<QComboBox*>("viewGrid.path");
    path->setCurrentIndex(path->findData(static_cast<int>(render::CameraPath::Snake)));
    connect(&grid, &ViewGrid::viewSelected, &grid, &ViewGrid::setCurrent);
    std::vector<ViewIndex> played;
    connect(&grid, &ViewGrid::viewSelected, &grid, [&](ViewIndex view) { played.push_back(view); });
    auto* button = grid.findChild<QToolButton*>("viewGrid.play");
    grid.setCurrent({2, 2});

    button->click();
    QVERIFY(grid.isPlaying());
    QTRY_VERIFY_WITH_TIMEOUT(played.size() >= 9, 5000);
    button->click();

    QVERIFY(!grid.isPlaying());
    // From the end of the snake back to its beginning, and on.
    QCOMPARE(played[0], (ViewIndex{2, 1}));
    QCOMPARE(played[7], (ViewIndex{0, 0}));
    QCOMPARE(played[8], (ViewIndex{0, 1}));
  }

  void newGrid_stopsPlaying() {
    ViewGrid grid;
    grid.setGrid({3, 3});
    grid.setPlaying(true);
    QVERIFY(grid.isPlaying());

    grid.setGrid({5, 5});

    QVERIFY(!grid.isPlaying());
    QCOMPARE(grid.current(), (ViewIndex{2, 2}));
  }

  void gridOfNothing_cannotPlay() {
    ViewGrid grid;

    grid.setPlaying(true);

    QVERIFY(!grid.isPlaying());
    QVERIFY(!grid.findChild<QToolButton*>("viewGrid.play")->isEnabled());
  }
};

}  // namespace episcope::in_view_grid_test

EPISCOPE_WINDOW_TEST(view_grid_test, ViewGridTest)
#include "view_grid_test.moc"
